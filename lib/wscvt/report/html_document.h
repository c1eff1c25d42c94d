// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptor_table.h"

namespace wscvt {

/// A figure of a document, with its caption.
struct Figure {
  std::string content;  ///< HTML or SVG
  std::string caption;  ///< plain text
};

/// Returns bytes as base64, for data within a document.
std::string base64(const std::string& bytes);

/// Content of a table's columns: a name and numbers, or an option and its description.
enum class RowKind { Numbers, Typed };

/// A document for reading and printing, built part by part. It is one file without references to
/// other files. Tables scroll in a narrow window.
class HtmlDocument {
 public:
  explicit HtmlDocument(const std::string& title);

  void add_heading(const std::string& text);
  void add_paragraph(const std::string& text);
  /// Adds a sentence that must not be overlooked.
  void add_warning(const std::string& text);

  /// Adds rows of cells. The first row is the head.
  void add_rows(const std::vector<std::vector<std::string>>& rows, RowKind kind = RowKind::Numbers);
  /// Adds rows of which only the line `summary` is seen until it is clicked.
  void add_collapsed_rows(const std::string& summary,
                          const std::vector<std::vector<std::string>>& rows,
                          RowKind kind = RowKind::Numbers);
  void add_table(const std::vector<DescriptorValue>& values);
  void add_table(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names);

  /// Adds lines with aligned columns, such as a log.
  void add_lines(const std::vector<std::string>& lines);

  /// Adds figures, side by side if there is room.
  void add_figures(const std::vector<Figure>& figures);

  /// Adds HTML unchanged.
  void add_html(const std::string& html) { body_ += html; }

  /// The whole document.
  std::string text() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace wscvt
