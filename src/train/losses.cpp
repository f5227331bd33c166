#include <cstdio>
#include <map>

#include "base/plot.h"
#include "train/trainer.h"

namespace panache {

std::string losses_csv(const std::vector<LossPoint>& losses) {
  std::string text = "network,step,train,validation\n";
  for (const LossPoint& point : losses) {
    char line[128];
    std::snprintf(line, sizeof line, "%s,%lld,%.6f,%.6f\n", point.network.c_str(),
                  static_cast<long long>(point.step), point.train, point.validation);
    text += line;
  }
  return text;
}

std::string losses_svg(const std::vector<LossPoint>& losses) {
  const std::map<std::string, std::string> colours = {
      {"pose", "#c2410c"}, {"timing", "#1d4ed8"}, {"contact", "#15803d"}};
  std::vector<PlotSeries> series;
  for (const auto& [network, colour] : colours) {
    PlotSeries train{network + ", training", {}, {}, colour};
    PlotSeries validation{network + ", validation", {}, {}, colour + "80"};
    for (const LossPoint& point : losses) {
      if (point.network != network) continue;
      train.x.push_back(static_cast<double>(point.step));
      train.y.push_back(point.train);
      validation.x.push_back(static_cast<double>(point.step));
      validation.y.push_back(point.validation);
    }
    series.push_back(std::move(train));
    series.push_back(std::move(validation));
  }
  return line_plot("Loss while training", "step", "loss", series, true);
}

}  // namespace panache
