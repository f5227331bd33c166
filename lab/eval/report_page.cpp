// The report as one page that needs nothing but itself.

#include "base/xml.h"
#include "eval/report.h"

#include "eval/report_numbers.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

struct Section {
  const char* id;
  const char* title;
  const char* introduction;
  std::string body;
};

std::vector<Section> sections_of(const Report& report) {
  return {
      {"judged", "Training and test data",
       "All figures are measured on held-out takes, with the same code for every system. "
       "Accuracies count only if the classifiers recognise real held-out takes well enough.",
       page_evaluated(report)},
      {"overall", "Overall",
       "Means over styles and contents that the systems were trained on. The best system of each "
       "column is in bold, with a dot.",
       page_overall(report)},
      {"content", "By content",
       "Means over the styles; the best system of each row is in bold, with a dot.",
       page_by_content(report)},
      {"style", "By style",
       "Means over the contents; the best system of each row is in bold, with a dot.",
       page_by_style(report)},
      {"performers", "Judges of performers",
       "Each performer's judge knows this performer's training takes alone, and tells whole clips "
       "of real held-out takes and of restyled neutral motion among the performer's styles. What "
       "it recognises of real takes is as much as there is to recognise.",
       page_clips(report)},
      {"strength", "Strength",
       "The effect of strength: 0 is the input, 1 the style as captured, above 1 exaggeration.",
       page_strength(report)},
      {"mixes", "Mixes", "Two styles at half strength each.", page_mixes(report)},
      {"unseen", "Contents left out of training",
       "Their styled takes were left out of training. For comparison: the same contents with them "
       "in training, real takes classified by classifiers that were not trained on these contents, "
       "and the mean posture of the style.",
       page_unseen(report)},
      {"foreign", "Out-of-distribution motion",
       "Clips from other data sets and other actions, each in every style at strength 1. There is "
       "no ground truth: the question is whether the motion stays intact.",
       page_ood(report)},
      {"disturbances", "Disturbances",
       "Pose error when only the input windows of a system are disturbed.",
       page_disturbances(report)},
      {"foresight", "Input prediction",
       "Mean joint error in centimetres when the input is predicted, continued at constant "
       "velocity, or held. Live, a style that is faster than its input needs prediction.",
       page_prediction(report)},
      {"strips", "Strips", "The same time span in each row. The body's left is lighter.",
       page_strips(report)},
      {"contacts", "Foot contacts", "A bar is a foot on the ground.", page_contacts(report)},
      {"literature", "CC and SC++",
       "As papers after 2020 compute them on the data of Xia et al. 2015. Published: CC 8.5, SC++ "
       "63.0 (MoST 2024, on another split).",
       page_literature(report)},
      {"cost", "Cost", "Of one character on one core.", page_cost(report)},
      {"definitions", "Definitions",
       "Shares lie between 0 and 1. A dash stands where nothing was measured.", page_definitions()},
  };
}

// "3 systems, 4 styles, 10 contents".
std::string subtitle(const Report& report) {
  const auto count = [](size_t n, const std::string& what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  return count(report.systems.size(), "system") + ", " + count(report.styles.size(), "style") +
         ", " + count(report.contents.size(), "content") + ".";
}

}  // namespace

std::string report_page(const Report& report) {
  std::string links, body;
  for (const Section& section : sections_of(report)) {
    if (section.body.empty()) continue;
    const std::string id = section.id, title = xml_escaped(section.title);
    links += "<a href=\"#" + id + "\">" + title + "</a>\n";
    body += "<section id=\"" + id + "\">\n<h2>" + title + "</h2>\n" +
            html_paragraph(section.introduction) + section.body + "</section>\n";
  }
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
         "<title>Panache: evaluation</title>\n<style>" +
         page_look() +
         "</style>\n</head>\n<body>\n<header>\n<h1>Motion style transfer: evaluation</h1>\n" +
         html_paragraph(subtitle(report)) + "<nav>\n" + links + "</nav>\n</header>\n<main>\n" +
         body + "</main>\n</body>\n</html>\n";
}

}  // namespace panache
