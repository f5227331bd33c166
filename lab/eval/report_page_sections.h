#pragma once
// The sections of the page, each as HTML; empty where the report has nothing for it.

#include <string>

#include "eval/report.h"

namespace panache {

// One table of the numbers of several sources side by side: a row per name, a group of columns per
// measure (by its key), in it a column per source that has any number of it.
struct MetricsSource {
  std::string name;
  const MetricsTable* table = nullptr;
  bool competes = false;  // For the best of its row.
};
std::string metrics_matrix(const std::string& rows_are, const std::vector<std::string>& rows,
                           const std::vector<MetricsSource>& sources,
                           const std::vector<const char*>& measures,
                           const std::string& last_row = "");

// report_page_metrics.cpp: actions that the systems were trained on.
std::string page_evaluated(const Report& report);
std::string page_overall(const Report& report);
std::string page_by_content(const Report& report);
std::string page_by_style(const Report& report);
std::string page_strength(const Report& report);

// report_page_beyond.cpp: what they were not trained on.
std::string page_unseen(const Report& report);
std::string page_ood(const Report& report);
std::string page_disturbances(const Report& report);
std::string page_mixes(const Report& report);

// report_page_clips.cpp: whole clips before the judges of performers.
std::string page_clips(const Report& report);
std::string page_unseen_clips(const UnseenReport& split);

// report_page_prediction.cpp: input that has not come yet.
std::string page_prediction(const Report& report);

// report_page_pictures.cpp
std::string page_strips(const Report& report);
std::string page_contacts(const Report& report);

// report_page_notes.cpp
std::string page_literature(const Report& report);
std::string page_cost(const Report& report);
std::string page_definitions();

// report_page_look.cpp: the style sheet.
std::string page_look();

}  // namespace panache
