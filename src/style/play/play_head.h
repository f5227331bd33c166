#pragma once
// A play head that lags or leads the live input within bounds.

namespace panache {

// A style plays its input faster or slower than it arrives. Live, the head can lag by `max_lag`
// and, if input is predicted, lead by `max_lead`; near a bound the rate eases to 1. Without a style
// it returns to the newest input.
class PlayHead {
 public:
  // Seconds, both 0 or more.
  PlayHead(double max_lag, double max_lead) : max_lag_(max_lag), max_lead_(max_lead) {}

  void reset() noexcept { ahead_ = 0; }
  // Advances by `seconds` of the clock; `rate`: the style's input seconds per second, ignored
  // unless `styled`. Returns the input seconds that the head moved.
  double advance(double seconds, double rate, bool styled) noexcept;
  // Jumps by `seconds` in the input.
  void jump(double seconds) noexcept { ahead_ += seconds; }

  // Seconds from the newest input to the head; negative: it lags.
  double ahead() const noexcept { return ahead_; }
  // How freely a style can still play faster (slower) than its input, 0 to 1.
  double room_ahead() const noexcept;
  double room_behind() const noexcept;

  // Calls visit(member) for everything that tells one head from another with its bounds.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.ahead_);
  }

 private:
  // The rate eases over this time before a bound, at most half the distance of the bounds. Seconds.
  double ease() const noexcept;

  double max_lag_, max_lead_;
  double ahead_ = 0;
};

}  // namespace panache
