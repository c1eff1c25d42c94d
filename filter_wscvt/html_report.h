// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/base/indexed_mesh.h"
#include "wscvt/measures/descriptor_table.h"

namespace wscvt::filter {

/// A document for reading, in parts that follow each other; figures stand inside it as vector
/// graphics (SVG), so that it is one file. Needs a QApplication and its thread when it has figures.
class HtmlReport {
 public:
  explicit HtmlReport(const std::string& title);

  void add_paragraph(const std::string& text);
  void add_table(const std::vector<DescriptorValue>& values);
  void add_table(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names);

  /// Lines whose columns are aligned, such as a log.
  void add_lines(const std::string& title, const std::vector<std::string>& lines);

  /// Distributions of the edge length and of the edge ratio, as the paper's figure 7. Each mesh as
  /// quality_histograms takes it; without faces it is left out. Throws Error(InvalidInput) when
  /// there is no QApplication to draw with.
  void add_histograms(const IndexedMesh& reference, const IndexedMesh& mesh,
                      const ComparisonNames& names);

  /// The whole document.
  std::string text() const;

 private:
  void add_rows(const std::vector<std::vector<std::string>>& rows);

  std::string title_;
  std::string body_;
};

}  // namespace wscvt::filter
