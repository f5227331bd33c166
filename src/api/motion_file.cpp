#include <cmath>

#include "api/errors.h"
#include "api/objects.h"
#include "api/options.h"
#include "api/poses.h"
#include "base/text.h"
#include "clip/motion_format.h"
#include "pose/step_rate.h"
#include "retarget/retarget.h"
#include "rig/body_motions.h"

using namespace panache;
using namespace panache::api;

namespace {

// The motion with this index, the rest pose for -1, null if there is none.
const Clip* find_clip(const panache_motion_file& file, int32_t clip) {
  if (clip == -1) return &file.rest;
  return clip >= 0 && static_cast<size_t>(clip) < file.names.size() ? &file.file->clip(clip)
                                                                    : nullptr;
}

Error no_clip(const panache_motion_file& file, int32_t clip) {
  return {file.path + ": there is no motion " + std::to_string(clip) + "; it has " +
          std::to_string(file.names.size())};
}

// A body at rest, with the rig inferred from the motion.
Result<std::pair<Clip, Rig>> with_rig(const Clip& motion, const RigOptions& options) {
  Result<Rig> rig = Rig::create(motion, options);
  if (!rig) return rig.error();
  return std::pair{rest_clip(motion.skeleton), *std::move(rig)};
}

// An edit and the frames that it points to.
struct Edit {
  int clip;
  Clip frames;
  std::vector<double> source_frames;
  std::string name;
};

Result<std::vector<double>> read_source_frames(const panache_clip_edit& from, const Clip& own,
                                               const std::string& where) {
  const int32_t count = from.frames.frame_count;
  if (!from.source_frames && count != own.frames) {
    return Error{where + "has " + std::to_string(count) + " frames and no source_frames; the " +
                 "motion has " + std::to_string(own.frames)};
  }
  std::vector<double> out;
  for (int32_t f = 0; f < count; ++f) {
    out.push_back(from.source_frames ? from.source_frames[f] : f);
    if (!(out.back() >= 0 && out.back() <= own.frames - 1)) {
      return Error{where + "source frame " + std::to_string(f) + " is " +
                   std::to_string(out.back()) + "; expected 0 to " +
                   std::to_string(own.frames - 1)};
    }
  }
  return out;
}

Result<Edit> read_edit(const panache_motion_file& file, const panache_clip_edit& from,
                       const std::string& where) {
  const Clip* own = find_clip(file, from.clip);
  if (!own) return no_clip(file, from.clip);
  Result<Clip> read = read_clip(from.frames, own->skeleton, Rotations::as_given, where + "frames");
  if (!read) return read.error();
  if (read->frames == 0) return Error{where + "has no frames"};
  Edit out{
      from.clip == -1 ? kNewClip : from.clip, *std::move(read), {}, from.name ? from.name : ""};
  if (out.clip == kNewClip) return out;
  if (out.frames.frame_time != own->frame_time) {
    return Error{where + "has frames " + std::to_string(out.frames.frame_time) +
                 " seconds apart; those of the motion are " + std::to_string(own->frame_time)};
  }
  Result<std::vector<double>> source = read_source_frames(from, *own, where);
  if (!source) return source.error();
  out.source_frames = *std::move(source);
  return out;
}

Result<std::vector<Edit>> read_edits(const panache_motion_file& file, const panache_clip_edit* from,
                                     int32_t count) {
  const MotionFormat* format = find_format(motion_formats(), extension_of(file.path));
  const bool holds_one = format->one_motion;
  const char* kind = format->encoded_as == ".bvh" ? "BVH" : "VRMA";
  if (count < 1 || (holds_one && count > 1)) {
    return Error{
        file.path + ": " + std::to_string(count) + " edits; expected " +
        (holds_one ? std::string("1, as a ") + kind + " file holds one motion" : "1 or more")};
  }
  std::vector<Edit> edits;
  for (int32_t e = 0; e < count; ++e) {
    Result<Edit> edit = read_edit(file, from[e], "edit " + std::to_string(e) + ": ");
    if (!edit) return edit.error();
    edits.push_back(*std::move(edit));
  }
  return edits;
}

panache_status create(const void* bytes, size_t size, const char* name, const ReadOptions& options,
                      panache_motion_file** out) {
  start(out);
  return guarded([&] {
    auto file = parse_motion({static_cast<const char*>(bytes), size}, name, options);
    if (!file) return fail(PANACHE_BAD_FILE, file.error());
    auto names = (*file)->clip_names();
    std::vector<char> moves(names.size());
    for (const int clip : find_body_motions(**file).clips) moves[clip] = 1;
    Clip rest = (*file)->rest();
    for (std::string& clip_name : names) clip_name = to_utf8(clip_name);
    for (Joint& joint : rest.skeleton.joints) joint.name = to_utf8(joint.name);
    *out = new panache_motion_file{*std::move(file), name, std::move(names), std::move(moves),
                                   std::move(rest)};
    return PANACHE_OK;
  });
}

}  // namespace

panache_status panache_motion_file_create(const void* bytes, size_t size, const char* name,
                                          panache_motion_file** out) {
  return create(bytes, size, name, {}, out);
}

panache_status panache_motion_file_create_at_rate(const void* bytes, size_t size, const char* name,
                                                  double frames_per_second,
                                                  panache_motion_file** out) {
  if (auto good = check_fps(frames_per_second); !good) {
    start(out);
    return fail(PANACHE_BAD_ARGUMENT, good.error());
  }
  return create(bytes, size, name, {frames_per_second}, out);
}

int32_t panache_motion_file_clip_moves(const panache_motion_file* file, int32_t clip) {
  return clip >= 0 && find_clip(*file, clip) ? file->moves[clip] : 0;
}

panache_status panache_motion_file_get_notes(const panache_motion_file* file, panache_bytes** out) {
  start(out);
  return guarded([&] {
    std::string text;
    for (const std::string& note : motion_notes(*file->file, file->path))
      text += to_utf8(note) + "\n";
    *out = new panache_bytes{std::move(text)};
    return PANACHE_OK;
  });
}

void panache_motion_file_destroy(panache_motion_file* file) { delete file; }

int32_t panache_motion_file_joint_count(const panache_motion_file* file) {
  return static_cast<int32_t>(file->rest.joints());
}

void panache_motion_file_get_joint(const panache_motion_file* file, int32_t joint,
                                   panache_joint* out) {
  const Joint& from = file->rest.skeleton.joints[joint];
  const Quat q = from.rest;
  const Vec3 v = from.offset;
  *out = {from.name.c_str(), from.parent, {q.x, q.y, q.z, q.w}, {v.x, v.y, v.z}};
}

int32_t panache_motion_file_clip_count(const panache_motion_file* file) {
  return static_cast<int32_t>(file->names.size());
}

const char* panache_motion_file_clip_name(const panache_motion_file* file, int32_t clip) {
  return clip >= 0 && find_clip(*file, clip) ? file->names[clip].c_str() : nullptr;
}

panache_status panache_motion_file_get_clip(const panache_motion_file* file, int32_t clip,
                                            panache_clip* out) {
  return guarded([&] {
    const Clip* found = find_clip(*file, clip);
    if (!found) return fail(PANACHE_BAD_ARGUMENT, no_clip(*file, clip));
    *out = {nullptr, found->frames, found->frame_time, &found->rotations.data()->x,
            &found->translations.data()->x};
    return PANACHE_OK;
  });
}

panache_status panache_motion_file_create_skeleton(const panache_motion_file* file, int32_t clip,
                                                   const panache_skeleton_options* options,
                                                   panache_skeleton** out) {
  start(out);
  return guarded([&] {
    const auto given = read_struct<panache_skeleton_options>(options, PANACHE_SKELETON_OPTIONS,
                                                             "panache_skeleton_options");
    if (!given) return fail(PANACHE_BAD_ARGUMENT, given.error());
    const Clip* found = find_clip(*file, clip);
    if (!found) return fail(PANACHE_BAD_ARGUMENT, no_clip(*file, clip));
    const auto rig_options = read_rig_options(*given, panache_motion_file_joint_count(file));
    if (!rig_options) return fail(PANACHE_BAD_ARGUMENT, rig_options.error());
    auto body = clip == -1 ? find_body(file->rest, find_clip(*file, first_body_motion(*file->file)),
                                       *rig_options)
                           : with_rig(*found, *rig_options);
    if (!body) return fail(PANACHE_BAD_SKELETON, located(file->path, body.error()));
    Skeleton joints = body->first.skeleton;
    *out = new panache_skeleton{std::move(body->second), std::move(joints), std::move(body->first)};
    return PANACHE_OK;
  });
}

panache_status panache_motion_file_write(const panache_motion_file* file,
                                         const panache_clip_edit* edits, int32_t edit_count,
                                         panache_edit_mode mode, panache_bytes** out) {
  start(out);
  return guarded([&] {
    if (mode < PANACHE_REPLACE || mode > PANACHE_ADD_FIRST) {
      return fail(PANACHE_BAD_ARGUMENT,
                  {"there is no edit mode " + std::to_string(mode) + "; expected 0 to 2"});
    }
    const auto read = read_edits(*file, edits, edit_count);
    if (!read) return fail(PANACHE_BAD_ARGUMENT, read.error());
    std::vector<ClipEdit> list;
    for (const Edit& edit : *read) {
      list.push_back({edit.clip, &edit.frames, edit.source_frames, edit.name});
    }
    constexpr EditMode kModes[] = {EditMode::replace, EditMode::add_beside, EditMode::add_first};
    *out = new panache_bytes{file->file->encode(list, kModes[mode])};
    return PANACHE_OK;
  });
}
