#include <cmath>
#include <cstdio>

#include "draw/plot.h"
#include "train/trainer.h"

namespace panache {

namespace {

std::string cell(float loss) {
  if (std::isnan(loss)) return "";
  char text[64];
  std::snprintf(text, sizeof text, "%.6f", loss);
  return text;
}

}  // namespace

std::string losses_csv(const std::vector<LossPoint>& losses) {
  std::string text = "network,step,train,validation\n";
  for (const LossPoint& point : losses) {
    text += point.network + "," + std::to_string(point.step) + "," + cell(point.train) + "," +
            cell(point.validation) + "\n";
  }
  return text;
}

std::string losses_svg(const std::vector<LossPoint>& losses) {
  struct Look {
    const char *network, *training, *validation;
  };
  constexpr Look looks[] = {{"pose", "#c2410c", "#fdba74"},
                            {"timing", "#1d4ed8", "#93c5fd"},
                            {"contact", "#15803d", "#86efac"},
                            {"predict", "#7e22ce", "#d8b4fe"}};
  std::vector<PlotSeries> series;
  for (const Look& look : looks) {
    const std::string network = look.network;
    PlotSeries train{network + ", training", {}, {}, look.training};
    PlotSeries validation{network + ", validation", {}, {}, look.validation};
    for (const LossPoint& point : losses) {
      if (point.network != network) continue;
      train.x.push_back(static_cast<double>(point.step));
      train.y.push_back(point.train);
      if (std::isnan(point.validation)) continue;
      validation.x.push_back(static_cast<double>(point.step));
      validation.y.push_back(point.validation);
    }
    if (train.x.empty()) continue;
    series.push_back(std::move(train));
    if (!validation.x.empty()) series.push_back(std::move(validation));
  }
  return line_plot("Loss while training", "step", "loss", series, true);
}

}  // namespace panache
