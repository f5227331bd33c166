#include "bench_systems.h"

#include <algorithm>

namespace panache::cli {
namespace {

using bench::Measurements;
using bench::Timing;

constexpr int kGameCrowd = 1000;  // The crowd size that the headline number is for.

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

// Columns of text: the first left-aligned, the others right-aligned. The first row is the heading.
std::string columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line = row[0] + std::string(widths[0] - row[0].size(), ' ');
    for (size_t c = 1; c < row.size(); ++c) {
      line += std::string(2 + widths[c] - row[c].size(), ' ') + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string us(double value) { return fixed(value, value < 100 ? 2 : 0); }
std::string times(double value) { return fixed(value, value < 10 ? 2 : 0) + " x"; }

// 8,765 and 1,234,567.
std::string grouped(int64_t value) {
  std::string text = std::to_string(value);
  for (size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string bytes_text(double bytes) {
  return bytes < 1e6 ? fixed(bytes / 1e3, bytes < 1e5 ? 1 : 0) + " KB"
                     : fixed(bytes / 1e6, 1) + " MB";
}

std::vector<std::string> timing_cells(const Timing& timing, double ours) {
  return {us(timing.warm), us(timing.low) + " to " + us(timing.high), us(timing.cold),
          times(timing.warm / ours)};
}

std::string forward_table(const Measurements& m, double ours) {
  std::vector<std::vector<std::string>> rows = {
      {"forward pass", "warm", "8 of 10 rounds", "cold", "of ours"}};
  for (const bench::ForwardPass& pass : m.forward_passes) {
    if (!pass.timing) continue;
    std::vector<std::string> row = timing_cells(*pass.timing, ours);
    row.insert(row.begin(), pass.key == "panache_half" ? "Panache, int8 weights" : pass.name);
    rows.push_back(std::move(row));
  }
  return columns(rows);
}

std::string others_table(const Measurements& m, double ours) {
  std::vector<std::vector<std::string>> rows = {
      {"in our kernels", "warm", "8 of 10 rounds", "cold", "of ours", "weights", "as published"}};
  for (const bench::OtherNetwork& other : m.others) {
    std::vector<std::string> row = timing_cells(other.timing, ours);
    row.insert(row.begin(), other.name);
    row.push_back(bytes_text(static_cast<double>(other.bytes)));
    row.push_back(other.published);
    rows.push_back(std::move(row));
  }
  return columns(rows);
}

std::string steps_table(const Measurements& m) {
  const bench::StepTimes& steps = m.steps;
  const auto quantile = [&](double at) { return us(steps.steps.quantile(at) / 1e3); };
  std::string text = columns(
      {{"one step, " + m.model + ", int8", "p50", "p99", "p99.9", "worst", "cold"},
       {grouped(steps.steps.count()) + " steps", quantile(0.5), quantile(0.99), quantile(0.999),
        us(static_cast<double>(steps.steps.worst()) / 1e3), us(steps.cold / 1e3)}});
  const auto over_networks = [](const bench::StepTimes& of) {
    return fixed(of.whole / of.networks, 1);
  };
  text += "a step of this walk takes " + over_networks(steps) + " times its networks";
  for (const auto& [name, hard] : m.hard_steps) {
    text += "; of a " + name + " on 84 joints " + us(hard.steps.quantile(0.5) / 1e3) + ", " +
            over_networks(hard) + " times";
  }
  text += "\nother programs took the core " + grouped(steps.interruptions) +
          (steps.interruptions == 1 ? " time" : " times") +
          " meanwhile; each makes one step longer\n";
  std::vector<std::vector<std::string>> rows = {{"its parts", "p50", "share"}};
  double rest = steps.whole;
  const auto add = [&](const std::string& name, double ns) {
    rows.push_back({name, us(ns / 1e3), fixed(100 * ns / steps.whole, 0) + " %"});
  };
  for (const auto& stage : steps.stages) {
    rest -= stage.median;
    add(stage.name, stage.median);
  }
  add("everything else", rest);
  add("together", steps.whole);
  return text + "\n" + columns(rows);
}

std::string crowd_table(const Measurements& m) {
  std::vector<std::vector<std::string>> rows = {
      {"crowd", "a character", "characters at 60 Hz", "int8", "characters at 60 Hz"}};
  for (size_t c = 0; c < m.crowds.size(); ++c) {
    const bench::CrowdTime &crowd = m.crowds[c], &int8 = m.int8_crowds[c];
    rows.push_back({grouped(crowd.characters), us(crowd.us_per_character),
                    grouped(characters_at_60hz(crowd)), us(int8.us_per_character),
                    grouped(characters_at_60hz(int8))});
  }
  return columns(rows);
}

std::string memory_table(const Measurements& m) {
  return columns({{"memory", ""},
                  {"model", bytes_text(static_cast<double>(m.model_bytes))},
                  {"int8 model", bytes_text(static_cast<double>(m.int8_model_bytes))},
                  {"a character", bytes_text(m.character_bytes)}});
}

std::string systems_table(const std::vector<SystemTime>& systems) {
  if (systems.empty()) return "";
  std::vector<std::vector<std::string>> rows = {
      {"system", "a frame", "frames a second", "of ours", "memory"}};
  for (const SystemTime& system : systems) {
    rows.push_back({system.name, us(system.frame_us),
                    grouped(static_cast<int64_t>(1e6 / system.frame_us)),
                    times(system.frame_us / systems.front().frame_us),
                    bytes_text(static_cast<double>(system.bytes))});
  }
  return "\n" + columns(rows);
}

std::string missing_text(const Measurements& m) {
  std::string text;
  for (const bench::ForwardPass& pass : m.forward_passes) {
    if (!pass.missing.empty()) text += "missing: " + pass.name + " (" + pass.missing + ")\n";
  }
  if (!text.empty()) {
    text += "./run bench in a checkout of the sources installs and builds what is missing\n";
  }
  return text;
}

}  // namespace

int characters_at_60hz(const bench::CrowdTime& crowd) {
  return static_cast<int>(1e6 / 60 / crowd.us_per_character);
}

Json to_json(const Measurements& m, const std::vector<SystemTime>& systems) {
  Json forward, cold, spread, names, missing = Json::object(), peers, published, peer_bytes;
  for (const bench::ForwardPass& pass : m.forward_passes) {
    forward[pass.key] = or_null(m.forward_us(pass.key));
    if (pass.timing) {
      cold[pass.key] = pass.timing->cold;
      spread[pass.key] = {pass.timing->low, pass.timing->high};
      names[pass.key] = pass.name;
    } else {
      missing[pass.key] = pass.missing;
    }
  }
  for (const bench::OtherNetwork& other : m.others) {
    peers[other.key] = other.timing.warm;
    cold[other.key] = other.timing.cold;
    spread[other.key] = {other.timing.low, other.timing.high};
    names[other.key] = other.name;
    published[other.key] = other.published;
    peer_bytes[other.key] = other.bytes;
  }
  Json stages, crowds = Json::array();
  for (const auto& stage : m.steps.stages) stages[stage.name] = stage.median / 1e3;
  std::optional<double> at_60hz, at_60hz_int8;
  for (size_t c = 0; c < m.crowds.size(); ++c) {
    const bench::CrowdTime &crowd = m.crowds[c], &int8 = m.int8_crowds[c];
    crowds.push_back({{"characters", crowd.characters},
                      {"us_per_character", crowd.us_per_character},
                      {"characters_at_60hz", characters_at_60hz(crowd)},
                      {"us_per_character_half", int8.us_per_character},
                      {"characters_at_60hz_half", characters_at_60hz(int8)}});
    if (crowd.characters != kGameCrowd) continue;
    at_60hz = characters_at_60hz(crowd);
    at_60hz_int8 = characters_at_60hz(int8);
  }
  const bench::Histogram& steps = m.steps.steps;
  Json over_networks = {{"walk", m.steps.whole / m.steps.networks}};
  for (const auto& [name, hard] : m.hard_steps) over_networks[name] = hard.whole / hard.networks;
  Json frames = Json::object(), memory = Json::object();
  for (const SystemTime& system : systems) {
    frames[system.name] = system.frame_us;
    memory[system.name] = system.bytes;
  }
  return {{"machine",
           {{"processor", m.limits.processor},
            {"kernels", m.kernels},
            {"one_core", m.pinned},
            {"clock_us", m.clock_ns / 1e3},
            {"memory_gb_s", m.limits.memory_gb_s},
            {"cache_gb_s",
             static_cast<double>(m.network_bytes) / 1e3 / m.forward_us("read_limit").value_or(0)},
            {"multiply_and_add_gflops", m.limits.apart_gflops},
            {"fused_gflops", m.limits.fused_gflops}}},
          {"rounds", m.rounds},
          {"forward_pass_us", forward},
          {"peers_us", peers},
          {"step_us",
           {{"p50", steps.quantile(0.5) / 1e3},
            {"p99", steps.quantile(0.99) / 1e3},
            {"p99_9", steps.quantile(0.999) / 1e3},
            {"worst", static_cast<double>(steps.worst()) / 1e3},
            {"networks", m.steps.networks / 1e3}}},
          // The higher number, because the user chooses the crowd's model; and both.
          {"characters_at_60hz", or_null(std::max(at_60hz, at_60hz_int8))},
          {"characters_at_60hz_float32", or_null(at_60hz)},
          {"characters_at_60hz_half", or_null(at_60hz_int8)},
          {"bytes",
           {{"model", m.model_bytes},
            {"model_half", m.int8_model_bytes},
            {"character", m.character_bytes}}},
          {"steps", steps.count()},
          {"interruptions", m.steps.interruptions},
          {"step_cold_us", m.steps.cold / 1e3},
          {"step_over_networks", over_networks},
          {"stages_us", stages},
          {"crowds", crowds},
          {"cold_us", cold},
          {"spread_us", spread},
          {"names", names},
          {"peers_bytes", peer_bytes},
          {"peers_published", published},
          {"systems_frame_us", frames},
          {"systems_bytes", memory},
          {"missing", missing}};
}

std::string describe(const Measurements& m, const std::vector<SystemTime>& systems) {
  const double ours = *m.forward_us("panache");
  const double reading = *m.forward_us("read_limit");
  const double bytes = static_cast<double>(m.network_bytes);
  return m.limits.processor + ", " + (m.pinned ? "one core" : "not tied to a core") + ", kernels " +
         m.kernels + "; medians of " + grouped(m.rounds) + " rounds, microseconds\n" + "reads " +
         fixed(bytes / 1e3 / reading, 0) + " GB/s from its caches (" + bytes_text(bytes) + "), " +
         fixed(m.limits.memory_gb_s, 1) + " GB/s from memory; multiplies and adds " +
         fixed(m.limits.apart_gflops, 0) + " GFLOP/s, fused " + fixed(m.limits.fused_gflops, 0) +
         "\n\n" + forward_table(m, ours) + "\n" + others_table(m, ours) + "\n" + steps_table(m) +
         "\n" + crowd_table(m) + "\n" + memory_table(m) + systems_table(systems) + missing_text(m);
}

}  // namespace panache::cli
