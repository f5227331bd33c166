// panache live: motion from trackers in, the same motion in another style out to avatars, while it
// happens (VMC protocol).

#include <chrono>
#include <cstdio>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "base/file.h"
#include "clip/bvh.h"
#include "clip/text_cursor.h"
#include "live_view.h"
#include "messages.h"
#include "model_path.h"
#include "outputs.h"
#include "page_server.h"
#include "removal_options.h"
#include "send.h"
#include "shape_options.h"
#include "stop_signal.h"
#include "strengths.h"
#include "usage_error.h"
#include "verbs.h"
#include "vmc_relay.h"

namespace panache::cli {
namespace {

struct Options {
  std::string in = "39539", out = "39540";
  std::vector<std::string> styles;
  std::string model, record;
  panache::LiveOptions time;
  ShapeFlags shape;
  RemovalFlags removal;
  bool view = false, quiet = false, force = false;
};

// One strength per style of the model.
Result<std::vector<float>> read_styles(const std::vector<std::string>& texts, const Model& model) {
  Result<std::vector<StrengthWish>> wishes = parse_styles(texts, model);
  if (!wishes) return wishes.error();
  std::vector<float> strengths(model.styles().size());
  for (const StrengthWish& wish : *wishes) {
    const auto style = static_cast<size_t>(wish.track.style);
    if (wish.over_clip) {
      return Error{"--style " + model.styles()[style].name + "=" + describe(wish) +
                   ": live motion has no end to change towards; expected one strength"};
    }
    strengths[style] = wish.track.points.front().strength;
  }
  return strengths;
}

// What is sent to the port that is listened at would come in again, and again.
Result<void> check_no_circle(const sockaddr_in& in, const sockaddr_in& out) {
  const uint32_t from = ntohl(in.sin_addr.s_addr), to = ntohl(out.sin_addr.s_addr);
  const bool to_itself =
      from == to || ((from == INADDR_ANY || from >> 24 == IN_LOOPBACKNET) && to == INADDR_ANY) ||
      (from == INADDR_ANY && to >> 24 == IN_LOOPBACKNET);
  if (out.sin_port != in.sin_port || !to_itself) return {};
  return Error{"--vmc-out: expected another port than that of --vmc-in, found " +
               std::to_string(ntohs(in.sin_port)) + " for both"};
}

Result<void> check_record(const Options& options) {
  if (options.record.empty() || options.record.ends_with(".bvh")) return {};
  return Error{"--record " + options.record + ": expected a name that ends in .bvh"};
}

void relay_until_stopped(VmcRelay& relay, bool quiet) {
  double next = stamp_now() + 1;
  while (!stop_asked()) {
    relay.run_once();
    // Also where the clock was set back.
    if (stamp_now() < next && stamp_now() > next - 2) continue;
    next = stamp_now() + 1;
    const std::string line = relay.second(), note = relay.take_note();
    if (!note.empty()) print_message(note);
    if (!quiet) print_message(line);
  }
  relay.finish();
}

void print_summary(const VmcRelay& relay, double seconds) {
  const VmcCounts& all = relay.all();
  print("relayed " + plural(static_cast<size_t>(all.frames), "frame") + " of " +
        plural(relay.senders(), "sender") + " in " + fixed(seconds, 1) +
        " s: " + std::to_string(all.lost) + " lost, " + std::to_string(all.rejected) +
        " rejected, p50 " + std::to_string(all.latencies.quantile_us(0.5)) + " us, p99 " +
        std::to_string(all.latencies.quantile_us(0.99)) + " us\n");
}

Result<void> write_recording(const VmcRecording& recording, const Options& options) {
  if (recording.frames() == 0) {
    return Error{options.record + ": not written, because no sender has a humanoid"};
  }
  const Clip clip = recording.clip();
  auto written = write_file(options.record, format_bvh(clip), options.force);
  if (!written) return written;
  print("recorded " + plural(recording.frames(), "frame") + " (" + fixed(clip.duration(), 1) +
        " s) into " + options.record + (recording.full() ? ", which is full\n" : "\n"));
  return {};
}

// Answers the page's requests beside the relay, as long as it exists.
class Serving {
 public:
  // `server` may be null.
  explicit Serving(PageServer* server) : server_(server) {
    if (!server) return;
    over_ = std::async(std::launch::async, [server] {
      if (auto served = server->listen(); !served) print_message(served.error().message);
    });
  }
  ~Serving() {
    // A stop that comes before the server listens is not heard.
    while (server_ && over_.wait_for(kStopEvery) != std::future_status::ready) server_->stop();
  }
  Serving(const Serving&) = delete;
  Serving& operator=(const Serving&) = delete;

 private:
  static constexpr std::chrono::milliseconds kStopEvery{10};

  PageServer* server_;
  std::future<void> over_;
};

int live(const Options& options) {
  Result<sockaddr_in> in = parse_address(options.in, "--vmc-in", "0.0.0.0");
  if (!in) return fail(in.error(), kBadUsage);
  Result<sockaddr_in> out = parse_address(options.out, "--vmc-out");
  if (!out) return fail(out.error(), kBadUsage);
  for (const Result<void>& good : {check_no_circle(*in, *out), check_record(options)}) {
    if (!good) return fail(good.error(), kBadUsage);
  }
  if (!options.record.empty()) {
    auto free = check_output("", options.record, options.force);
    if (!free) return fail(free.error(), kBadInput);
  }
  LiveOptions how = options.time;
  if (auto shape = read_shape(options.shape, how.stylizer); !shape) {
    return fail(shape.error(), kBadUsage);
  }
  Result<std::string> path = find_model(options.model);
  if (!path) return fail(path.error(), kBadInput);
  Result<std::shared_ptr<const Model>> model = Model::load(*path);
  if (!model) return fail(model.error(), kBadInput);
  Result<std::vector<float>> strengths = read_styles(options.styles, **model);
  if (!strengths) return fail(strengths.error(), kBadUsage);
  int exit_code = kDone;
  const Result<std::optional<Removal>> removal = read_removal(options.removal, exit_code);
  if (!removal) return fail(removal.error(), exit_code);
  if (*removal) how.remover = (*removal)->remover;
  if (auto good = LiveStylizer::check(**model, options.time); !good) {
    return fail({*path + ": " + good.error().message}, kBadUsage);
  }
  Result<UdpSocket> socket = UdpSocket::listen(*in, "--vmc-in");
  if (!socket) return fail(socket.error(), kBadInput);

  LiveView view;
  std::unique_ptr<PageServer> server;
  if (options.view) {
    Result<std::unique_ptr<PageServer>> page = PageServer::create();
    if (!page) return fail(page.error(), kBadInput);
    server = *std::move(page);
    // For as many poses as each reader is fast enough for.
    server->serve("/live/body.bvh", [&view] { return view.body(); });
    server->serve_events("/live/poses", [&view] {
      return [&view, known = uint64_t{0}]() mutable { return view.next(known); };
    });
    print("http://" + server->address() + "/?live\n");
    print_message("open this address in a browser to see what goes out");
    std::fflush(stdout);
  }

  watch_stop_signals();
  const Serving serving(server.get());
  VmcRecording recording;
  VmcRelay relay(*std::move(socket), *out, *std::move(model), how, *std::move(strengths),
                 options.record.empty() ? nullptr : &recording, server ? &view : nullptr,
                 *removal ? (*removal)->style : -1);
  if (!options.quiet) {
    print_message("relaying from " + listened_at(*in) + " to " + to_string(*out) +
                  " until Ctrl-C ends it");
  }
  const double begin = stamp_now();
  relay_until_stopped(relay, options.quiet);
  print_summary(relay, stamp_now() - begin);
  if (options.record.empty()) return kDone;
  auto written = write_recording(recording, options);
  return written ? kDone : fail(written.error(), kBadInput);
}

// What comes before 'send' would be read for live and then be ignored.
Result<void> check_nothing_before_send(const CLI::App& live) {
  for (const CLI::Option* option : live.get_options()) {
    if (option->count() > 0) {
      return Error{option->get_name() +
                   ": 'live send' has no such option; see panache live send "
                   "--help"};
    }
  }
  return {};
}

}  // namespace

void add_live(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("live", "Restyle live motion (VMC protocol)");
  auto options = std::make_shared<Options>();
  verb->add_option("--vmc-in", options->in,
                   "Port that trackers send to: PORT of all addresses of\n"
                   "this machine, or HOST:PORT of one; default: 39539")
      ->type_name("ADDRESS");
  verb->add_option("--vmc-out", options->out,
                   "Port of the avatars: PORT on this machine or\nHOST:PORT; default: 39540")
      ->type_name("ADDRESS");
  verb->add_option("--style", options->styles,
                   "NAME=STRENGTH: 0 is neutral, 1 the style as captured,\n"
                   "above 1 exaggerates (-4 to 4). One --style per style")
      ->allow_extra_args(false)
      ->type_name("STYLE");
  add_removal_options(*verb, options->removal);
  add_shape_options(*verb, options->shape);
  verb->add_option("--model", options->model,
                   "Model; default: $PANACHE_MODEL, else the one shipped")
      ->type_name("FILE");
  verb->add_option("--record", options->record,
                   "Write the first sender's styled motion (.bvh) when\nthe program ends")
      ->type_name("FILE");
  verb->add_option("--max-lag", options->time.max_lag,
                   "Maximum lag for slower styles, 0 to 4 seconds;\ndefault: 0")
      ->check(in_range(0.0, panache::LiveOptions::kMaxLag))
      ->type_name("SECONDS");
  verb->add_option(
          "--max-lead", options->time.max_lead,
          "Maximum lead for faster styles, using predicted\ninput, 0 to 0.25 seconds; default: 0")
      ->check(in_range(0.0, PredictorNetwork::kMaxSeconds))
      ->type_name("SECONDS");
  verb->add_flag("--skip-cycles", options->time.skip_cycles,
                 "Skip or repeat whole gait cycles to stay within the\n"
                 "limits, so that a tempo lasts (with --max-lag 1.5)");
  verb->add_flag("--view", options->view,
                 "Show the first sender's motion, before and after, on a page in a browser");
  verb->add_flag("--force", options->force, "Overwrite the recording");
  verb->add_flag("--quiet", options->quiet, "No statistics every second");
  verb->footer(
      "While it runs, the OSC messages '/panache/style NAME STRENGTH' and '/panache/reset' to\n"
      "the same port change a strength and reset what the styles added to the root motion.\n\n"
      "Examples:\n"
      "  panache live --style old=1\n"
      "  panache live --vmc-in 39539 --vmc-out 192.168.1.20:39540 --record show.bvh");
  const std::function<int()> run_send = add_send(*verb);
  verb->callback([=, &exit_code] {
    if (verb->get_subcommands().empty()) {
      exit_code = live(*options);
    } else if (auto good = check_nothing_before_send(*verb); !good) {
      exit_code = fail(good.error(), kBadUsage);
    } else {
      exit_code = run_send();
    }
  });
}

}  // namespace panache::cli
