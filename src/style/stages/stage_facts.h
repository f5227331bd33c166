#pragma once
// What the stages did at one instant, for reports.

namespace panache {

struct StageFacts {
  // 1 if something besides the feet supports the body, and hips and legs stay unchanged; see
  // SeatWatch.
  float seated = 0;
  float touching = 0;  // 1 if a hand keeps a contact, see HandContacts.
};

}  // namespace panache
