#include "pose/motion_notes.h"

#include "pose/step_rate.h"
#include "rig/body_motions.h"

namespace panache {

std::vector<std::string> motion_notes(const MotionFile& file, const std::string& path) {
  std::vector<std::string> notes = file.notes();
  const std::vector<std::string> names = file.clip_names();
  const BodyMotions body = find_body_motions(file);
  if (const std::string note = note_passed_over(file, body); !note.empty()) {
    notes.push_back(path + ": " + note);
  }
  for (const int clip : body.clips) {
    const std::string& name = names[static_cast<size_t>(clip)];
    const Result<Rig> rig = Rig::create(file.clip(clip));
    if (!rig) continue;  // The caller gets this error with that skeleton.
    if (const auto doubt = doubtful_rate(file.clip(clip), *rig)) {
      notes.push_back(path + ": " + (name.empty() ? "" : name + ": ") + *doubt);
    }
  }
  return notes;
}

}  // namespace panache
