// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/report/html_document.h"

#include <cstddef>
#include <cstdint>

#include "wscvt/base/text.h"
#include "wscvt/base/text_format.h"

namespace wscvt {

namespace {

// Figures are at least 20em wide: one column on a telephone, three in a wide window. One or two
// fill its width, up to 44em each, so that their texts are as large as the page's. In print, no
// page breaks inside a figure or row or after a heading. Three pictures fit side by side, but only
// two drawings, because of their texts. The log's lines are wrapped to the page.
constexpr const char* style =
    "body { font-family: sans-serif; max-width: 80em; margin: 2em auto; padding: 0 1em; "
    "color: #000; background: #fff; }\n"
    "h1 { overflow-wrap: anywhere; }\n"
    ".wide { overflow-x: auto; }\n"
    "table { border-collapse: collapse; }\n"
    "th, td { padding: 0.15em 0.8em; text-align: right; border-bottom: 1px solid #ddd; }\n"
    "th:first-child, td:first-child { text-align: left; }\n"
    "pre { overflow-x: auto; font-size: 0.85em; }\n"
    "details { margin: 0.7em 0; }\n"
    "summary { cursor: pointer; }\n"
    ".warning { border-left: 0.3em solid #c60; padding-left: 0.7em; }\n"
    ".figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(20em, 100%), "
    "1fr)); gap: 1em; margin-bottom: 1em; }\n"
    "figure { margin: 0; max-width: 44em; }\n"
    "figure svg, figure img { width: 100%; height: auto; }\n"
    "figcaption { font-size: 0.85em; color: #444; }\n"
    ".thumbs { display: grid; grid-template-columns: repeat(auto-fill, minmax(5em, 1fr)); gap: "
    "0.3em; max-height: 34em; overflow-y: auto; margin-bottom: 1em; }\n"
    ".thumbs figcaption { text-align: center; overflow-wrap: anywhere; }\n"
    ".turns img { display: none; }\n"
    ".turns canvas { width: 100%; aspect-ratio: 1; cursor: grab; display: block; }\n"
    "@media screen and (prefers-color-scheme: dark) { body { color: #ddd; background: #1b1b1b; } "
    "figcaption { color: #aaa; } a { color: #9cf; } svg, img { background: #fff; } }\n"
    ".typed td:first-child { font-family: monospace; white-space: nowrap; }\n"
    ".typed td, .typed th { text-align: left; }\n"
    "@media (max-width: 40em) { th, td { padding: 0.15em 0.3em; } table, pre { font-size: 0.8em; } "
    "}\n"
    "@media print { .thumbs { max-height: none; } .thumbs.thumbs { grid-template-columns: "
    "repeat(10, 1fr); } .turns img { display: inline; } .turns canvas { display: none; } body { "
    "margin: 0; padding: 0; max-width: none; font-size: 10pt; } h2 { "
    "break-after: avoid; } figure, tr, .warning { break-inside: avoid; } "
    ".wide { overflow: visible; "
    "} .figures { grid-template-columns: repeat(2, 1fr); } .figures:has(img) { "
    "grid-template-columns: repeat(3, 1fr); } figcaption { font-size: 8pt; } pre { white-space: "
    "pre-wrap; font-size: 6.5pt; } }\n";

std::string with_unit(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + ", " + unit;
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[group >> (18U - 6U * k) & 63U];
    }
  }
  return text;
}

HtmlDocument::HtmlDocument(const std::string& title) : title_(html_escaped(title)) {
  body_ = "<h1>" + title_ + "</h1>\n";
}

void HtmlDocument::add_heading(const std::string& text) {
  body_ += "<h2>" + html_escaped(text) + "</h2>\n";
}

void HtmlDocument::add_paragraph(const std::string& text) {
  body_ += "<p>" + html_escaped(text) + "</p>\n";
}

void HtmlDocument::add_warning(const std::string& text) {
  body_ += "<p class=\"warning\">" + html_escaped(text) + "</p>\n";
}

void HtmlDocument::add_rows(const std::vector<std::vector<std::string>>& rows, RowKind kind) {
  body_ += "<div class=\"wide\"><table";
  body_ += kind == RowKind::Typed ? " class=\"typed\">\n" : ">\n";
  for (const std::vector<std::string>& row : rows) {
    const std::string cell = &row == &rows.front() ? "th" : "td";
    body_ += "<tr>";
    for (const std::string& text : row) {
      body_.append("<").append(cell).append(">").append(html_escaped(text));
      body_.append("</").append(cell).append(">");
    }
    body_ += "</tr>\n";
  }
  body_ += "</table></div>\n";
}

void HtmlDocument::add_collapsed_rows(const std::string& summary,
                                      const std::vector<std::vector<std::string>>& rows,
                                      RowKind kind) {
  body_ += "<details><summary>" + html_escaped(summary) + "</summary>\n";
  add_rows(rows, kind);
  body_ += "</details>\n";
}

void HtmlDocument::add_table(const std::vector<DescriptorValue>& values) {
  std::vector<std::vector<std::string>> rows = {{"descriptor", "value"}};
  for (const DescriptorValue& row : values) {
    rows.push_back({with_unit(row.label, row.unit), format_number(row.value)});
  }
  add_rows(rows);
}

void HtmlDocument::add_table(const std::vector<DescriptorComparison>& comparison,
                             const ComparisonNames& names) {
  std::vector<std::vector<std::string>> rows = {
      {"descriptor", names.reference, names.value, "error %"}};
  for (const DescriptorComparison& row : comparison) {
    rows.push_back({with_unit(row.label, row.unit), format_number(row.reference),
                    format_number(row.value), format_error(row.error_percent)});
  }
  add_rows(rows);
}

void HtmlDocument::add_lines(const std::vector<std::string>& lines) {
  body_ += "<pre>\n";
  for (const std::string& line : lines) body_ += html_escaped(line) + "\n";
  body_ += "</pre>\n";
}

void HtmlDocument::add_figures(const std::vector<Figure>& figures) {
  body_ += "<div class=\"figures\">\n";
  for (const Figure& figure : figures) {
    body_ += "<figure>" + figure.content + "<figcaption>" + html_escaped(figure.caption) +
             "</figcaption></figure>\n";
  }
  body_ += "</div>\n";
}

std::string HtmlDocument::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         title_ + "</title>\n<style>\n" + style + "</style>\n</head>\n<body>\n" + body_ +
         "</body>\n</html>\n";
}

}  // namespace wscvt
