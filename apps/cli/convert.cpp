// panache convert: converts motion files between formats.

#include <functional>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "base/file.h"
#include "formats.h"
#include "input.h"
#include "messages.h"
#include "onto.h"
#include "rig/body_motions.h"
#include "rig_report.h"
#include "verbs.h"

namespace panache::cli {
namespace {

void account(FileJob& file, const std::string& name, const Clip& clip) {
  file.clips.push_back({{"name", name}, {"frames", clip.frames}, {"seconds", clip.duration()}});
  file.frames += clip.frames;
  file.seconds += clip.duration();
}

// The humanoid motions of a file, kept in place.
std::vector<NewMotion> motions_in_place(const MotionFile& motion, const RigOptions& options) {
  std::vector<NewMotion> out;
  for (const int which : find_body_motions(motion, options).clips) {
    const Result<Rig> rig = Rig::create(motion.clip(which), options);
    if (!rig) continue;
    NewMotion& moved = out.emplace_back(NewMotion{.clip = motion.clip(which), .which = which});
    stay_in_place(*rig, moved.clip);
    moved.source_frames.resize(static_cast<size_t>(moved.clip.frames));
    std::iota(moved.source_frames.begin(), moved.source_frames.end(), 0.0);
  }
  return out;
}

// All content of a file that keeps its format.
std::string whole_file(const MotionFile& motion, const FileJob& file, const MotionFlags& verb,
                       const RigOptions& options) {
  const std::string from = extension_of(file.input);
  const bool is_changed = must_be_encoded(from) || becomes_glb(file.input, file.output) ||
                          verb.read.fps || motion.is_mended() || verb.in_place;
  const std::vector<NewMotion> motions =
      verb.in_place ? motions_in_place(motion, options) : std::vector<NewMotion>();
  std::string bytes = is_changed   ? motion.encode(edits_of(motions), EditMode::replace)
                      : file.bytes ? *file.bytes
                                   : need(read_file(file.input));
  if (from == extension_of(file.output)) return bytes;
  return need(in_container(std::move(bytes), file.input, file.output, options, verb.no_body));
}

std::string need_of(const std::string& path, Result<std::string> bytes) {
  if (!bytes) throw Failure{located(path, bytes.error()), kBadInput};
  return *std::move(bytes);
}

std::string convert_whole(const MotionFile& motion, FileJob& file, const MotionFlags& verb,
                          const RigOptions& options) {
  if (!verb.clip.empty()) {
    throw Failure{{file.input + ": all its motions are written to " + file.output +
                   "; expected no --clip, which is for formats that hold one motion"},
                  kBadInput};
  }
  const std::vector<std::string> names = motion.clip_names();
  for (size_t i = 0; i < names.size(); ++i) {
    account(file, names[i], motion.clip(static_cast<int>(i)));
  }
  for (const int clip : find_body_motions(motion, options).clips) {
    const std::string& name = names[static_cast<size_t>(clip)];
    const std::string where = name.empty() ? file.input : file.input + ": " + name;
    // Only a humanoid has steps.
    const Result<Rig> rig = make_rig(motion.clip(clip), options, where);
    if (rig) note_rate(motion.clip(clip), *rig, where, file.notes);
  }
  return whole_file(motion, file, verb, options);
}

std::string convert_motion(const MotionFile& motion, FileJob& file, const MotionFlags& verb,
                           const RigOptions& options) {
  const std::vector<int> picked =
      need(pick_clips(motion, verb.clip, options, file.input, file.notes));
  need(check_fits(motion, picked, file.input, file.output));
  Clip clip = motion.clip(picked.front());
  const std::string name = motion.clip_names()[static_cast<size_t>(picked.front())];
  account(file, name, clip);
  const std::string title = title_of(name, file.input);
  const std::string extension = extension_of(file.output);
  const Result<Rig> rig = make_rig(clip, options, file.input);
  if (rig) {
    file.mapping = mapping_json(*rig);
    note_rate(clip, *rig, file.input, file.notes);
    if (verb.in_place) stay_in_place(*rig, clip);
    return need_of(file.input,
                   format_clip(clip, &*rig, title, placement_of(*rig), extension, verb.no_body));
  }
  // Joint options apply only to humanoids.
  if (!options.joints.empty() || holds_humanoids(extension) || verb.in_place) {
    throw Failure{rig.error(), kBadInput};
  }
  if (find_format(formats(), extension)->in_metres &&
      !(options.metres_per_unit && options.up_axis)) {
    file.notes.push_back(file.input +
                         ": is not a humanoid, so unit and up axis cannot be inferred; taken as "
                         "metres and +Y unless --scale and --up are given");
  }
  return need_of(file.input,
                 format_clip(clip, nullptr, title, placement_of(options), extension, verb.no_body));
}

void convert_file(FileJob& file, const MotionFlags& verb, const RigOptions& options) {
  const std::unique_ptr<MotionFile> motion = open_input(file, verb.read);
  const bool keeps = keeps_format(extension_of(file.input), extension_of(file.output));
  write_output(file, (keeps ? convert_whole : convert_motion)(*motion, file, verb, options),
               verb.batch.force);
}

int convert(const MotionFlags& verb) {
  need(check_rig_flags(verb.rig), kBadUsage);
  need(check_read_options(verb.read), kBadUsage);
  if (!verb.onto.file.empty()) {
    return retarget_files(verb, {}, "converting", "converted");
  }
  std::vector<FileJob> files = plan_batch(verb.batch, {}, "");
  for (const FileJob& file : files) need(check_format(file.input, file.output), kBadUsage);
  const FileJob& first = files.front();
  const std::string output = verb.batch.output.value_or(first.output);
  if (verb.batch.to.empty() && !first.to_stdout && first.output != output) {
    return fail({"--output " + output + ": is a folder; expected --to with it, as in --to bvh"},
                kBadUsage);
  }
  const RigOptions rig = need(read_rig_options(verb.rig));
  return run_batch(
      std::move(files), verb.batch, "", "converting", "converted",
      [&](FileJob& file, const std::function<void(double)>&) { convert_file(file, verb, rig); });
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("convert", "Convert motion files to another format");
  auto options = std::make_shared<MotionFlags>();
  add_batch_options(*verb, options->batch);
  add_option(*verb, "--clip NAME", options->clip, "Motion to convert, if a file has several");
  add_onto_options(*verb, options->onto);
  add_result_options(*verb, *options);
  add_rig_options(*verb, options->rig);
  add_read_options(*verb, options->read);
  verb->footer(
      "docs/formats.md lists what each conversion keeps and loses.\n\n"
      "Examples:\n"
      "  panache convert walk.fbx -o walk.bvh\n"
      "  panache convert takes/ --to glb -o converted/");
  verb->callback([options, &exit_code] { exit_code = convert(*options); });
}

}  // namespace panache::cli
