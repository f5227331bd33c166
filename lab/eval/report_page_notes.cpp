// Sections of the page: measures of the literature, cost, and what every number means.

#include <cmath>

#include "base/xml.h"
#include "eval/measure.h"
#include "eval/report_numbers.h"
#include "eval/report_page_html.h"
#include "eval/report_page_sections.h"

namespace panache {
namespace {

struct Definition {
  const char* term;
  const char* meaning;
};

// Beside those of the measures.
constexpr Definition kDefinitions[] = {
    {"takes, windows", "How many takes were evaluated, and how many windows they have."},
    {"judge of a performer",
     "Tells one performer's styles and neutral motion apart, from this performer's training takes "
     "alone, in windows of two seconds; a clip is taken for what most of its windows are."},
    {"recognised, of real",
     "Share of clips taken for the style asked for, and the same divided by the share of real "
     "held-out takes."},
    {"cm beside recognised",
     "Mean distance of the joints in the body frame from the nearest real take of that style, "
     "action and performer, warped in time; of real held-out takes from training takes."},
    {"hands' speed, hands' sharpness",
     "Mean speed of the hands, and their jerk per speed, divided by those of the real takes."},
    {"unseen, seen",
     "Results on contents whose styled takes were left out of training, and of the same system "
     "trained with them."},
    {"real, blind",
     "Real styled takes of the unseen contents, classified by classifiers that were not trained on "
     "these contents: an upper bound."},
    {"mean posture",
     "The style's mean change of posture and tempo over its training pairs, for any motion: the "
     "simplest transfer."},
    {"jerk / input",
     "Mean jerk of the joints against that of the input; 1 is as smooth as the "
     "input."},
    {"velocity correlation",
     "Correlation of the velocities of hands and feet, in the body frame, "
     "with the input's; 1 is the same motion."},
    {"beyond limits", "Share of frames with a joint outside human limits, less the input's own."},
    {"under the floor",
     "Share of frames with a toe 3 cm lower than both the floor and the "
     "input."},
    {"jumps", "Frames in which a joint jumps by more than 6 cm that the input lacks."},
    {"pairs", "A pair is an out-of-distribution clip in a style."},
    {"drift", "Distance between the final hip positions of output and input on the ground."},
    {"gate", "Share of the dynamic change that the gate lets through: 1 all, 0 posture only."},
    {"pose error under a disturbance",
     "The error in cm above, when only the input windows of the system are disturbed."},
    {"rank correlation",
     "Spearman's correlation of the strengths up to 1 with the style's probability, and up to 2 "
     "with the distance from the input; 1 if more strength always does more."},
    {"either style, correlation",
     "Of a mix of two styles: share of windows recognised as one of "
     "the two, and correlation of the share of the second with how "
     "much more probable it is than the first."},
    {"CC",
     "Distance of the output from the input when the asked style is the input's own: every "
     "second frame, 21 joints, file units, summed over joints, mean over frames."},
    {"SC++",
     "Mean distance between the output and every real clip of the asked style and content, "
     "cut to the shorter and unaligned, in the same units."},
    {"bone length error", "Largest change of the length of any bone."},
    {"step", "Processor time of one step of one character on one core."},
};

}  // namespace

std::string page_literature(const Report& report) {
  HtmlTable table("");
  table.add_columns("", {"CC", "SC++"});
  if (std::isfinite(report.cc_floor) || std::isfinite(report.sc_floor)) {
    table.add_row("real takes against real takes",
                  {{number_text(report.cc_floor, 2)}, {number_text(report.sc_floor, 2)}});
  }
  bool first = true;
  std::vector<double> cc, sc;
  for (const SystemReport& system : report.systems) {
    cc.push_back(system.cc);
    sc.push_back(system.sc);
  }
  const std::vector<bool> best_cc = best_of(cc, Better::lower, 2);
  const std::vector<bool> best_sc = best_of(sc, Better::lower, 2);
  for (size_t s = 0; s < cc.size(); ++s) {
    if (!std::isfinite(cc[s]) && !std::isfinite(sc[s])) continue;
    table.add_row(report.systems[s].name,
                  {{number_text(cc[s], 2), best_cc[s]}, {number_text(sc[s], 2), best_sc[s]}},
                  first);
    first = false;
  }
  return first ? "" : table.str();
}

std::string page_cost(const Report& report) {
  HtmlTable table("");
  table.add_columns("",
                    {"recipe", "step \xc2\xb5s", "model", "parameters", "bone length error cm"});
  bool any = false;
  for (const SystemReport& system : report.systems) {
    any |= std::isfinite(system.step_us) || std::isfinite(system.bone_length_error_cm) ||
           system.model_bytes > 0 || system.parameters > 0;
    table.add_row(system.name, {{system.recipe.empty() ? kDash : system.recipe},
                                {number_text(system.step_us, 2)},
                                {bytes_text(system.model_bytes)},
                                {count_text(system.parameters)},
                                {number_text(system.bone_length_error_cm, 4)}});
  }
  return any ? table.str() : "";
}

std::string page_definitions() {
  std::string out = "<dl class=\"definitions\">\n";
  const auto define = [&](const char* term, const char* meaning) {
    out += "<dt>" + xml_escaped(term) + "</dt><dd>" + xml_escaped(meaning) + "</dd>\n";
  };
  for (const Measure& measure : measures()) define(measure.label, measure.meaning);
  for (const Definition& definition : kDefinitions) define(definition.term, definition.meaning);
  return out + "</dl>\n";
}

}  // namespace panache
