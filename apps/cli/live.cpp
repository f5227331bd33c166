// panache live: restyles motion from trackers in real time and sends it on to avatars (VMC
// protocol).

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
#include "person_options.h"
#include "program.h"
#include "sides.h"
#include "stop_signal.h"
#include "strengths.h"
#include "style_options.h"
#include "verbs.h"
#include "vmc_relay.h"

namespace panache::cli {
namespace {

constexpr const char* kTrackerPort = "39539";

struct Options {
  std::string in = kTrackerPort, out = "39540";
  std::vector<std::string> styles, sides;
  std::string model, record;
  panache::LiveOptions time;
  PersonFlags person;
  ShapeFlags shape;
  RemovalFlags removal;
  double smooth = 0;
  bool mirror = false, view = false, quiet = false, force = false;
};

// One strength per style of the model.
std::vector<float> read_styles(const std::vector<std::string>& texts, const Model& model) {
  std::vector<float> strengths(model.styles().size());
  for (const StrengthWish& wish : need(parse_styles(texts, model), kBadUsage)) {
    const auto style = static_cast<size_t>(wish.track.style);
    if (wish.over_clip) {
      throw Failure{{"--style " + model.styles()[style].name + "=" + describe(wish) +
                     ": live motion has no end to change towards; expected one strength"},
                    kBadUsage};
    }
    strengths[style] = wish.track.points.front().strength;
  }
  return strengths;
}

// Output sent to the input port would loop for ever.
Result<void> check_no_circle(const sockaddr_in& in, const sockaddr_in& out) {
  const uint32_t from = ntohl(in.sin_addr.s_addr), to = ntohl(out.sin_addr.s_addr);
  const bool to_itself =
      from == to || ((from == INADDR_ANY || from >> 24 == IN_LOOPBACKNET) && to == INADDR_ANY) ||
      (from == INADDR_ANY && to >> 24 == IN_LOOPBACKNET);
  if (out.sin_port != in.sin_port || !to_itself) return {};
  return Error{"--vmc-out: expected another port than that of --vmc-in, found " +
               std::to_string(ntohs(in.sin_port)) + " for both"};
}

// What to do where no motion comes in.
std::string connect_hint(const sockaddr_in& in) {
  const bool all = ntohl(in.sin_addr.s_addr) == INADDR_ANY;
  const std::string port = std::to_string(ntohs(in.sin_port));
  return "no motion comes in yet: let the tracker send VMC (its settings call it VMC or OSC) to " +
         (all ? "this machine, 127.0.0.1 if it runs here, at port " + port : to_string(in)) +
         "; 'panache live send walk.bvh" + (port == kTrackerPort ? "" : " --to " + port) +
         "' plays a file as a tracker";
}

void relay_until_stopped(VmcRelay& relay, const sockaddr_in& in, bool quiet) {
  bool silent = false;
  double next = stamp_now() + 1;
  while (!stop_asked()) {
    relay.run_once();
    // Also when the clock was set back.
    if (stamp_now() < next && stamp_now() > next - 2) continue;
    next = stamp_now() + 1;
    const std::string line = relay.second(), note = relay.take_note();
    if (!note.empty()) print_message(note);
    // Silence is told once.
    if (!quiet && !line.empty()) print_message(line);
    if (!quiet && line.empty() && !silent) {
      print_message(relay.senders() == 0 ? connect_hint(in) : "no motion comes in any more");
    }
    silent = line.empty();
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

void write_recording(const VmcRecording& recording, const Options& options) {
  if (recording.frames() == 0) {
    throw Failure{{options.record + ": not written, because no sender has a humanoid"}, kBadInput};
  }
  const Clip clip = recording.clip();
  need(write_file(options.record, format_bvh(clip), options.force));
  print("recorded " + plural(recording.frames(), "frame") + " (" + fixed(clip.duration(), 1) +
        " s) into " + options.record + (recording.full() ? ", which is full\n" : "\n"));
}

// Serves the page in parallel with the relay, for the lifetime of this object.
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
    // A stop before the server listens has no effect, so it is repeated.
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
  const sockaddr_in in = need(parse_address(options.in, "--vmc-in", "0.0.0.0"), kBadUsage);
  const sockaddr_in out = need(parse_address(options.out, "--vmc-out"), kBadUsage);
  need(check_no_circle(in, out), kBadUsage);
  if (!options.record.empty() && !options.record.ends_with(".bvh")) {
    return fail({"--record " + options.record + ": expected a name that ends in .bvh"}, kBadUsage);
  }
  if (!options.record.empty()) need(check_output("", options.record, options.force));
  LiveOptions live_options = options.time;
  need(read_shape(options.shape, live_options.stylizer), kBadUsage);
  const std::string path = need(find_model(options.model));
  const std::shared_ptr<const Model> model = need(Model::load(path));
  const std::vector<float> strengths = read_styles(options.styles, *model);
  live_options.stylizer.sides = need(parse_sides(options.sides, *model), kBadUsage);
  const std::optional<PersonWish> person = read_person_options(options.person, *model);
  const std::optional<Removal> removal = read_removal(options.removal);
  if (removal) live_options.remover = removal->remover;
  if (auto good = LiveStylizer::check(*model, options.time); !good) {
    throw Failure{{path + ": " + good.error().message}, kBadUsage};
  }
  UdpSocket socket = need(UdpSocket::listen(in, "--vmc-in"));

  LiveView view;
  std::unique_ptr<PageServer> server;
  if (options.view) {
    server = need(PageServer::create());
    // Each reader gets as many poses as it can keep up with.
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
  VmcRelay relay(
      std::move(socket), out,
      {model, live_options, removal ? removal->style : -1, options.mirror, options.smooth,
       options.record.empty() ? nullptr : &recording, server ? &view : nullptr},
      strengths, person);
  if (!options.quiet) {
    print_message("relaying from " + listened_at(in) + " to " + to_string(out) +
                  " until Ctrl-C ends it");
  }
  const double begin = stamp_now();
  relay_until_stopped(relay, in, options.quiet);
  print_summary(relay, stamp_now() - begin);
  if (!options.record.empty()) write_recording(recording, options);
  return kDone;
}

// Options before 'send' would be read as options of live and then be ignored.
void check_nothing_before_send(const CLI::App& live) {
  for (const CLI::Option* option : live.get_options()) {
    if (option->count() == 0) continue;
    throw Failure{
        {option->get_name() + ": 'live send' has no such option; see panache live send --help"},
        kBadUsage};
  }
}

}  // namespace

void add_live(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("live", "Restyle live motion (VMC protocol)");
  auto options = std::make_shared<Options>();
  add_option(*verb, "--vmc-in ADDRESS", options->in,
             "Port that trackers send to: PORT of all addresses of\n"
             "this machine, or HOST:PORT of one; default: 39539");
  add_option(*verb, "--vmc-out ADDRESS", options->out,
             "Port of the avatars: PORT on this machine or\nHOST:PORT; default: 39540");
  add_option(*verb, "--style STYLE", options->styles,
             "NAME=STRENGTH: 0 is neutral, 1 the style as captured,\n"
             "above 1 exaggerates (-4 to 4). One --style per style")
      ->allow_extra_args(false);
  add_side_option(*verb, options->sides);
  add_person_options(*verb, options->person);
  add_removal_options(*verb, options->removal);
  add_shape_options(*verb, options->shape);
  add_option(*verb, "--model FILE", options->model,
             "Model; default: $PANACHE_MODEL, else the one shipped");
  add_option(*verb, "--record FILE", options->record,
             "Write the first sender's styled motion (.bvh) when\nthe program ends");
  add_option(*verb, "--max-lag SECONDS", options->time.max_lag,
             "Maximum lag for slower styles, 0 to 4 seconds;\ndefault: 0")
      ->check(in_range(0.0, panache::LiveOptions::kMaxLag));
  add_option(
      *verb, "--max-lead SECONDS", options->time.max_lead,
      "Maximum lead for faster styles, using predicted\ninput, 0 to 0.25 seconds; default: 0")
      ->check(in_range(0.0, PredictorNetwork::kMaxSeconds));
  verb->add_flag("--skip-cycles", options->time.skip_cycles,
                 "Skip or repeat whole gait cycles to stay within the\n"
                 "limits, so that a tempo lasts (with --max-lag 1.5)");
  verb->add_flag("--mirror", options->mirror,
                 "Exchange left and right: the avatar moves like a mirror");
  add_option(*verb, "--smooth SECONDS", options->smooth,
             "Smooth the tracked motion, delaying it by at most\nSECONDS (0 to 1); default: 0")
      ->check(in_range(0.0, VmcFilter::kMaxSmooth));
  verb->add_flag("--view", options->view,
                 "Show the first sender's motion, before and after, on a page in a browser");
  verb->add_flag("--force", options->force, "Overwrite the recording");
  verb->add_flag("--quiet", options->quiet, "No statistics every second");
  verb->footer(
      "While it runs, the OSC messages '/panache/style NAME STRENGTH', '/panache/side NAME SIDE'\n"
      "and '/panache/reset' to the same port change a strength and a side, and reset what the\n"
      "styles added to the root motion.\n\n"
      "Examples:\n"
      "  panache live --style old=1\n"
      "  panache live --vmc-in 39539 --vmc-out 192.168.1.20:39540 --record show.bvh");
  const std::function<int()> run_send = add_send(*verb);
  verb->callback([=, &exit_code] {
    const bool sends = !verb->get_subcommands().empty();
    if (sends) check_nothing_before_send(*verb);
    exit_code = sends ? run_send() : live(*options);
  });
}

}  // namespace panache::cli
