// SPDX-License-Identifier: GPL-3.0-or-later
#include "html_report.h"

#include <qwt_legend.h>
#include <qwt_plot.h>
#include <qwt_plot_grid.h>
#include <qwt_plot_histogram.h>
#include <qwt_plot_renderer.h>

#include <QApplication>
#include <QBuffer>
#include <QPainter>
#include <QSvgGenerator>

#include "wscvt/base/error.h"
#include "wscvt/base/text_format.h"
#include "wscvt/measures/mesh_quality.h"

namespace wscvt::filter {

namespace {

constexpr std::size_t histogram_bins = 60;
constexpr int figure_width = 560;
constexpr int figure_height = 340;

std::string escaped(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped().toStdString();
}

/// Bars of the share of the elements in each bin, in %.
void add_bars(QwtPlot& plot, const QString& title, const QColor& colour, const Histogram& histogram,
              std::size_t total) {
  QVector<QwtIntervalSample> samples;
  const double width =
      (histogram.upper - histogram.lower) / static_cast<double>(histogram.counts.size());
  for (std::size_t k = 0; k < histogram.counts.size(); ++k) {
    // Neighbours share an edge to the last bit; Qwt draws the outline of bars that touch as one.
    const double from = histogram.lower + width * static_cast<double>(k);
    const double to = histogram.lower + width * static_cast<double>(k + 1);
    const double share =
        100.0 * static_cast<double>(histogram.counts[k]) / static_cast<double>(total);
    samples.append(QwtIntervalSample(share, from, to));
  }
  QColor filling = colour;
  filling.setAlpha(110);
  // The plot owns what is attached to it.
  auto* bars = new QwtPlotHistogram(QwtText(title, QwtText::PlainText));
  bars->setStyle(QwtPlotHistogram::Outline);
  bars->setPen(colour, 1.0);
  bars->setBrush(filling);
  bars->setSamples(samples);
  bars->attach(&plot);
}

std::size_t total(const Histogram& histogram) {
  std::size_t sum = 0;
  for (const std::size_t count : histogram.counts) sum += count;
  return sum;
}

struct NamedHistogram {
  QString name;
  QColor colour;
  Histogram histogram;
};

std::string figure(const QString& axis, const QString& counted,
                   const std::vector<NamedHistogram>& histograms) {
  // A generic family: what draws the file chooses the font.
  const QFont font(QStringLiteral("sans-serif"), 9);
  QwtPlot plot;
  plot.resize(figure_width, figure_height);
  plot.setCanvasBackground(Qt::white);
  plot.setPalette(
      QPalette(Qt::black, Qt::white, Qt::white, Qt::gray, Qt::gray, Qt::black, Qt::white));
  const auto titled = [&](const QString& text) {
    QwtText title(text);
    title.setFont(font);
    return title;
  };
  plot.setAxisTitle(QwtPlot::xBottom, titled(axis));
  plot.setAxisTitle(QwtPlot::yLeft, titled(counted));
  for (const int side : {static_cast<int>(QwtPlot::xBottom), static_cast<int>(QwtPlot::yLeft)}) {
    plot.setAxisFont(side, font);
  }
  auto* legend = new QwtLegend();
  legend->setFont(font);
  plot.insertLegend(legend, QwtPlot::TopLegend);
  auto* grid = new QwtPlotGrid();
  grid->setPen(QColor(220, 220, 220), 0.0);
  grid->attach(&plot);
  for (const NamedHistogram& each : histograms) {
    add_bars(plot, each.name, each.colour, each.histogram, total(each.histogram));
  }
  const Histogram& first = histograms.front().histogram;
  plot.setAxisScale(QwtPlot::xBottom, first.lower, first.upper);
  plot.replot();

  QBuffer buffer;
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setResolution(plot.logicalDpiX());
  generator.setSize(QSize(figure_width, figure_height));
  generator.setViewBox(QRect(0, 0, figure_width, figure_height));
  generator.setTitle(axis);
  QPainter painter(&generator);
  QwtPlotRenderer renderer;
  renderer.setDiscardFlag(QwtPlotRenderer::DiscardBackground);
  renderer.setDiscardFlag(QwtPlotRenderer::DiscardCanvasFrame);
  renderer.render(&plot, &painter, QRectF(0, 0, figure_width, figure_height));
  painter.end();

  // Inside HTML there is neither an XML declaration nor a document type.
  const std::string svg = buffer.data().toStdString();
  return svg.substr(svg.find("<svg"));
}

}  // namespace

HtmlReport::HtmlReport(const std::string& title) : title_(escaped(title)) {
  body_ = "<h1>" + title_ + "</h1>\n";
}

void HtmlReport::add_paragraph(const std::string& text) {
  body_ += "<p>" + escaped(text) + "</p>\n";
}

void HtmlReport::add_rows(const std::vector<std::vector<std::string>>& rows) {
  body_ += "<table>\n";
  for (const std::vector<std::string>& row : rows) {
    const std::string cell = &row == &rows.front() ? "th" : "td";
    body_ += "<tr>";
    for (const std::string& text : row) {
      body_.append("<").append(cell).append(">").append(escaped(text));
      body_.append("</").append(cell).append(">");
    }
    body_ += "</tr>\n";
  }
  body_ += "</table>\n";
}

void HtmlReport::add_table(const std::vector<DescriptorValue>& values) {
  std::vector<std::vector<std::string>> rows = {{"descriptor", "unit", "value"}};
  for (const DescriptorValue& row : values) {
    rows.push_back({row.label, row.unit, format_number(row.value)});
  }
  add_rows(rows);
}

void HtmlReport::add_table(const std::vector<DescriptorComparison>& comparison,
                           const ComparisonNames& names) {
  std::vector<std::vector<std::string>> rows = {
      {"descriptor", "unit", names.reference, names.value, "error %"}};
  for (const DescriptorComparison& row : comparison) {
    rows.push_back({row.label, row.unit, format_number(row.reference), format_number(row.value),
                    format_error(row.error_percent)});
  }
  add_rows(rows);
}

void HtmlReport::add_lines(const std::string& title, const std::vector<std::string>& lines) {
  body_ += "<h2>" + escaped(title) + "</h2>\n<pre>\n";
  for (const std::string& line : lines) body_ += escaped(line) + "\n";
  body_ += "</pre>\n";
}

void HtmlReport::add_histograms(const IndexedMesh& reference, const IndexedMesh& mesh,
                                const ComparisonNames& names) {
  if (qobject_cast<QApplication*>(QCoreApplication::instance()) == nullptr) {
    throw Error(ErrorCode::InvalidInput,
                "The report's figures cannot be drawn without a window system; ask for a .json or "
                ".csv report.");
  }
  std::vector<NamedHistogram> lengths;
  std::vector<NamedHistogram> ratios;
  const auto add = [&](const std::string& name, const QColor& colour, const IndexedMesh& shown) {
    if (shown.triangles.empty()) return;
    QualityHistograms histograms = quality_histograms(shown, histogram_bins);
    const QString title = QString::fromStdString(name);
    lengths.push_back({title, colour, std::move(histograms.relative_edge_length)});
    ratios.push_back({title, colour, std::move(histograms.edge_ratio)});
  };
  add(names.reference, QColor(110, 110, 110), reference);
  add(names.value, QColor(0, 90, 180), mesh);
  if (lengths.empty()) return;
  body_ += "<h2>Edges</h2>\n<div class=\"figures\">\n";
  body_ += figure(QStringLiteral("edge length / mean edge length"),
                  QStringLiteral("share of the edges, %"), lengths);
  body_ += figure(QStringLiteral("longest / shortest edge of a triangle"),
                  QStringLiteral("share of the triangles, %"), ratios);
  body_ += "</div>\n";
  add_paragraph("Values beyond the right end are counted in the last bin.");
}

std::string HtmlReport::text() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + title_ +
         "</title>\n<style>\n"
         "body { font-family: sans-serif; max-width: 75em; margin: 2em auto; }\n"
         "table { border-collapse: collapse; }\n"
         "th, td { padding: 0.15em 0.8em; text-align: right; border-bottom: 1px solid #ddd; }\n"
         "th:first-child, td:first-child { text-align: left; }\n"
         "pre { overflow-x: auto; }\n"
         ".figures svg { max-width: 100%; width: 560px; height: auto; }\n"
         "</style>\n</head>\n<body>\n" +
         body_ + "</body>\n</html>\n";
}

}  // namespace wscvt::filter
