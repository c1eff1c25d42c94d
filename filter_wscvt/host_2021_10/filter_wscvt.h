// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/mlexception.h>
#include <common/plugins/interfaces/filter_plugin.h>

#include <map>
#include <string>

/// The filters for MeshLab 2021.10 to 2025.07. Only this class uses their interface.
class FilterWscvt : public QObject, public FilterPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
  Q_INTERFACES(FilterPlugin)

 public:
  FilterWscvt();

  QString pluginName() const override;
  QString vendor() const override;
  QString filterName(ActionIDType filter) const override;
  QString pythonFilterName(ActionIDType filter) const override;
  QString filterInfo(ActionIDType filter) const override;
  FilterClass getClass(const QAction* action) const override;
  FilterArity filterArity(const QAction* action) const override;
  int getPreConditions(const QAction* action) const override;
  int postCondition(const QAction* action) const override;

  using FilterPlugin::filterInfo;
  using FilterPlugin::filterName;
  using FilterPlugin::initParameterList;
  using FilterPlugin::pythonFilterName;
  RichParameterList initParameterList(const QAction* action, const MeshDocument& document) override;

  std::map<std::string, QVariant> applyFilter(const QAction* action,
                                              const RichParameterList& parameters,
                                              MeshDocument& document,
                                              unsigned int& postConditionMask,
                                              vcg::CallBackPos* callback) override;
};
