// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "wscvt/measures/descriptor_table.h"

namespace wscvt {

/// A figure of a document and what is to be seen in it.
struct Figure {
  std::string content;  ///< HTML or SVG
  std::string caption;  ///< plain text
};

/// What the columns of a table hold: numbers behind a name, or what one types and what it means.
enum class RowKind { Numbers, Typed };

/// A document for reading and for printing, in parts that follow each other. It is one file and
/// refers to no other. Tables scroll where a window is narrow.
class HtmlDocument {
 public:
  explicit HtmlDocument(const std::string& title);

  void add_heading(const std::string& text);
  void add_paragraph(const std::string& text);
  /// A sentence that must not be overlooked.
  void add_warning(const std::string& text);

  /// Rows of cells, the first of them the head.
  void add_rows(const std::vector<std::vector<std::string>>& rows, RowKind kind = RowKind::Numbers);
  void add_table(const std::vector<DescriptorValue>& values);
  void add_table(const std::vector<DescriptorComparison>& comparison, const ComparisonNames& names);

  /// Lines whose columns are aligned, such as a log.
  void add_lines(const std::vector<std::string>& lines);

  /// Figures, side by side where there is room.
  void add_figures(const std::vector<Figure>& figures);

  /// A part of the document as it stands.
  void add_html(const std::string& html) { body_ += html; }

  /// The whole document.
  std::string text() const;

 private:
  std::string title_;
  std::string body_;
};

}  // namespace wscvt
