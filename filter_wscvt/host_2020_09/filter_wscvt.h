// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/interfaces.h>
#include <common/mlexception.h>

/// The filters for MeshLab 2020.09. Only this class uses this version's interface.
class FilterWscvt : public QObject, public MeshFilterInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
  Q_INTERFACES(MeshFilterInterface)

 public:
  FilterWscvt();

  QString pluginName() const override;
  QString filterName(FilterIDType filter) const override;
  QString filterInfo(FilterIDType filter) const override;
  FilterClass getClass(QAction* action) override;
  FILTER_ARITY filterArity(QAction* action) const override;
  int getPreConditions(QAction* action) const override;
  int postCondition(QAction* action) const override;

  using MeshFilterInterface::initParameterSet;
  void initParameterSet(QAction* action, MeshDocument& document,
                        RichParameterList& parameters) override;

  bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                   vcg::CallBackPos* callback) override;
};
