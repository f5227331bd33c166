#pragma once
// What the stages changed at one instant, for reports.

namespace panache {

struct StageFacts {
  // 1 where something besides its feet holds the body up, and hips and legs are left as they are;
  // see SeatWatch.
  float seated = 0;
  float touching = 0;  // 1 where a hand keeps what it touches, see HandContacts.
};

}  // namespace panache
