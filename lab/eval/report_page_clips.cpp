// Section of the page: whole clips before the judges of performers.

#include <algorithm>
#include <map>

#include "draw/svg.h"
#include "base/xml.h"
#include "eval/report_clips.h"
#include "eval/report_numbers.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

std::string html(const ClipTable& from, const std::string& caption) {
  HtmlTable table(from.names);
  for (const auto& [label, columns] : from.groups) table.add_columns(label, columns);
  for (size_t r = 0; r < from.rows.size(); ++r) {
    std::vector<HtmlCell> cells;
    for (const ClipCell& cell : from.rows[r].second) {
      cells.push_back(
          {number_text(cell.value, cell.digits), false, cell.is_share ? cell.value : kNotMeasured});
    }
    table.add_row(from.rows[r].first, std::move(cells), r + 1 == from.rows.size());
  }
  return table.str(caption);
}

// The styles of each performer beside each other, in order of the performers.
std::vector<std::string> ordered_labels(const std::vector<ClipVerdict>& clips) {
  std::vector<std::string> labels;
  const auto add = [&](const std::string& label) {
    if (std::find(labels.begin(), labels.end(), label) == labels.end()) labels.push_back(label);
  };
  for (const auto& [performer, own] : clips_by(&ClipVerdict::performer, clips)) {
    for (const auto& [style, of_style] : clips_by(&ClipVerdict::style, own)) add(style);
  }
  for (const ClipVerdict& clip : clips) add(clip.verdict);
  return labels;
}

// Rows: what was asked for; columns: what it is taken for. A square is as dark as its share of the
// row, and holds its number of clips.
std::string confusion_drawing(const std::string& name, const std::vector<ClipVerdict>& clips,
                              const std::vector<std::string>& labels) {
  constexpr double kCell = 17, kText = 11, kGap = 5;
  const Confusion counts = confusion(clips);
  std::map<std::string, size_t> of_row;
  for (const auto& [pair, count] : counts) of_row[pair.first] += count;
  double margin = 0;
  for (const std::string& label : labels)
    margin = std::max(margin, text_width(label, kText) + 2 * kGap);
  const double side = kCell * static_cast<double>(labels.size());
  Svg svg(margin + side + kGap, margin + side + kGap);
  for (size_t i = 0; i < labels.size(); ++i) {
    const double at = margin + kCell * static_cast<double>(i);
    svg.line({margin, at}, {margin + side, at}, {"#e4e8ec", 0.5, 1, ""});
    svg.line({at, margin}, {at, margin + side}, {"#e4e8ec", 0.5, 1, ""});
    const double base = at + kCell / 2 + kText / 3;
    svg.text({margin - kGap, base}, labels[i], {kText, "#333333", TextStyle::Anchor::end});
    svg.text({base, margin - kGap}, labels[i],
             {kText, "#333333", TextStyle::Anchor::start, false, true});
  }
  for (const auto& [pair, count] : counts) {
    const auto place = [&](const std::string& label) {
      const auto found = std::find(labels.begin(), labels.end(), label);
      return margin + kCell * static_cast<double>(found - labels.begin());
    };
    const double x = place(pair.second), y = place(pair.first);
    const double share = static_cast<double>(count) / static_cast<double>(of_row[pair.first]);
    const std::string colour = pair.first == pair.second ? "#0065a3" : "#b3541e";
    svg.rect({x + 0.5, y + 0.5}, kCell - 1, kCell - 1, tinted(colour, 0.85 * (1 - share)));
    svg.text({x + kCell / 2, y + kCell / 2 + 3.2}, std::to_string(count),
             {9, share > 0.5 ? "#ffffff" : "#333333", TextStyle::Anchor::middle});
  }
  return "<h3>" + xml_escaped("What clips are taken for: " + name) + "</h3>\n" +
         html_drawing(svg.str(), "Confusion of styles, " + name, true);
}

}  // namespace

std::string page_clips(const Report& report) {
  const ClipTable own = own_clips_table(report);
  if (own.rows.empty()) return "";
  std::string out = html(own, "Share of clips recognised, and distance from the nearest real take");
  out +=
      html(clips_across_table(report),
           "Motion of other performers: before the judge of the style's performer, and of shared "
           "styles before their own");
  std::vector<ClipVerdict> all = report.real_clips;
  for (const SystemReport& system : report.systems) {
    all.insert(all.end(), system.clips.begin(), system.clips.end());
  }
  const std::vector<std::string> labels = ordered_labels(all);
  out += html_paragraph(
      "A row of a drawing is the style that was asked for, or that a real take shows; a column is "
      "what clips are taken for. Styles of one performer stand together.");
  out += confusion_drawing("real takes", report.real_clips, labels);
  for (const SystemReport& system : report.systems) {
    if (!system.clips.empty()) out += confusion_drawing(system.name, system.clips, labels);
  }
  return out;
}

std::string page_unseen_clips(const UnseenReport& split) {
  return html(unseen_clips_table(split), "Whole clips before the judges of their performers");
}

}  // namespace panache
