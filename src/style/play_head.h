#pragma once
// How far the play head may be from now, and how it gets there.

namespace panache {

// A style plays its input faster or slower than it comes. Live the head can be late by `max_lag`
// and, where input is predicted, ahead by `max_lead`; near a bound the rate eases to 1. Without a
// style it returns to now.
class PlayHead {
 public:
  // Seconds, both 0 or more.
  PlayHead(double max_lag, double max_lead) : max_lag_(max_lag), max_lead_(max_lead) {}

  void reset() noexcept { ahead_ = 0; }
  // Goes on by `seconds` of the clock; `rate`: input seconds per second that the style asks for, or
  // nothing where no style asks. Returns the input seconds that the head went.
  double advance(double seconds, double rate, bool styled) noexcept;
  // Goes on elsewhere: `seconds` later in the input.
  void jump(double seconds) noexcept { ahead_ += seconds; }

  // Seconds from now to the head: below zero it is late.
  double ahead() const noexcept { return ahead_; }
  // How much of the way a style that is faster (slower) than its input is still free to go, 0 to 1.
  double room_ahead() const noexcept;
  double room_behind() const noexcept;

  // Calls visit(member) for everything that tells one head from another with its bounds.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.ahead_);
  }

 private:
  // The rate eases over this much before a bound, or half of what lies between the bounds. Seconds.
  double ease() const noexcept;

  double max_lag_, max_lead_;
  double ahead_ = 0;
};

}  // namespace panache
