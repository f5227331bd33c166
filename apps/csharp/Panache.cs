// Panache for C#: styles the motion of a character, live. A single file over the shared library
// (libpanache.so, panache.dll or libpanache.dylib where the runtime looks for native libraries).
//
//     var model = Panache.Model.Load("panache-int8.safetensors");      // shared by all characters
//     var skeleton = new Panache.Skeleton(joints);                // shared by one rig's characters
//     var character = new Panache.Character(model, skeleton);
//     character.SetStrength("old", 1);
//     each frame: fill character.InputRotations and InputTranslations;
//                 character.Step(1.0 / 60);
//                 use character.Rotations and Translations
//
// Rotations are unit quaternions x, y, z, w; translations are x, y, z. Both are relative to the
// joint's parent, in the skeleton's units and axes (any right-handed ones). Joints are in the order
// in which the skeleton was given, parents before children. Failures throw a PanacheException with
// the library's message. Needs C# 7 and no unsafe code.

using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;

namespace Panache {

/// The library's error message about bad input.
public sealed class PanacheException : Exception {
  /// The kind of error, for programs that handle it.
  public ErrorKind Kind { get; }
  public PanacheException(string message, ErrorKind kind = ErrorKind.Other) : base(message) {
    Kind = kind;
  }
}

/// In the order of panache_error_kind.
public enum ErrorKind {
  Other, FileExists, RateNeeded, NotHumanoid, UnknownStyle, NoStyles, StyleExists, IsModel,
  IsStyleFile, StyleOfAnother, NotSafetensors, ModelCannotLearn, OtherSkeletons, LoopOpen,
  LoopStrengths, BadStyleName
}

/// A trained model: its styles and networks. Immutable; any number of threads may use it.
public sealed class Model : IDisposable {
  internal readonly Handle Handle;
  /// The bytes of the model file (.safetensors).
  public byte[] File { get; }
  /// The names of its styles, in the model's order.
  public IReadOnlyList<string> Styles { get; }
  /// The group of each style, "moods"; "" for learnt styles, and in models without groups.
  public IReadOnlyList<string> Groups { get; }
  /// The side that each style was captured on, as one sees it, "right leg"; "" if the model does not
  /// say.
  public IReadOnlyList<string> Sides { get; }
  /// The side of a style, for Character.SetSide(), that a word names: "captured", "mirrored" and, if
  /// Sides says which was captured, "left" and "right". Throws for other words.
  public float FindSide(string style, string word) {
    Native.Check(Native.panache_model_find_side(Handle, FindStyle(style), Native.Utf8(word),
                                                out float side));
    return side;
  }
  /// What each number of a person changes most, for Character.SetPerson(); empty if the model has
  /// no persons.
  public IReadOnlyList<string> PersonAxes { get; }
  /// The seed of a word, such as a character's name.
  public static uint PersonSeed(string word) => Native.panache_person_seed(Native.Utf8(word));
  /// The gestures of a style, "glances left, 1.2 s", for Character.Trigger(); often empty.
  public IReadOnlyList<string> Gestures(string style) => gestures[FindStyle(style)];
  private readonly List<List<string>> gestures = new List<List<string>>();

  public Model(byte[] file) {
    File = file;
    Native.Check(Native.panache_model_create(file, (UIntPtr)file.Length, out IntPtr model));
    Handle = new Handle(model, Native.panache_model_destroy);
    var styles = new List<string>();
    var groups = new List<string>();
    var sides = new List<string>();
    for (int i = 0; i < Native.panache_model_style_count(Handle); ++i) {
      var info = new Native.StyleInfo { structSize = Native.SizeOf<Native.StyleInfo>() };
      Native.Check(Native.panache_model_get_style_info(Handle, i, ref info));
      styles.Add(Native.Text(Native.panache_model_style_name(Handle, i)));
      groups.Add(Native.Text(info.group));
      sides.Add(Native.Text(info.side));
      gestures.Add(new List<string>());
      for (int k = 0; k < info.gestureCount; ++k) {
        gestures[i].Add(Native.Text(Native.panache_model_gesture_name(Handle, i, k)));
      }
    }
    Styles = styles;
    Groups = groups;
    Sides = sides;
    var axes = new List<string>();
    for (int i = 0; i < Native.panache_model_person_axis_count(Handle); ++i) {
      axes.Add(Native.Text(Native.panache_model_person_axis_name(Handle, i)));
    }
    PersonAxes = axes;
  }
  public static Model Load(string path) => new Model(System.IO.File.ReadAllBytes(path));
  /// The index of a style, by its name or another word for it; throws if the model has none.
  public int FindStyle(string name) {
    int index = Native.panache_model_find_style(Handle, Native.Utf8(name));
    if (index >= 0) return index;
    throw Native.LastError();
  }
  public void Dispose() => Handle.Dispose();
}

/// One joint of a skeleton: its rest transform relative to its parent. Parents come before their
/// children; the parent of a root is -1.
public sealed class Joint {
  public string Name = "";
  public int Parent = -1;
  public float[] Rotation = { 0, 0, 0, 1 };    // x, y, z, w
  public float[] Translation = { 0, 0, 0 };
}

/// A rig and its mapping to a humanoid, recognised by joint names and shape. Immutable.
public sealed class Skeleton : IDisposable {
  internal readonly Handle Handle;
  public int JointCount { get; }

  /// upAxis ("+Y", "-Z", ...) and metresPerUnit: null and 0 detect them. humanJoints: the index of
  /// each joint of the humanoid ("leftHand", VRM's names), -1 if the rig has none; joints that it
  /// does not list are detected.
  public Skeleton(IReadOnlyList<Joint> joints, string upAxis = null, float metresPerUnit = 0,
                  IReadOnlyDictionary<string, int> humanJoints = null) {
    using (var kept = new Kept()) {
      var native = new Native.Joint[joints.Count];
      for (int j = 0; j < native.Length; ++j) {
        float[] r = joints[j].Rotation, t = joints[j].Translation;
        native[j] = new Native.Joint {
          name = kept.Text(joints[j].Name), parent = joints[j].Parent,
          x = r[0], y = r[1], z = r[2], w = r[3], tx = t[0], ty = t[1], tz = t[2]
        };
      }
      var options = new Native.SkeletonOptions {
        structSize = Native.SizeOf<Native.SkeletonOptions>(), metresPerUnit = metresPerUnit,
        upAxis = upAxis == null ? IntPtr.Zero : kept.Text(upAxis)
      };
      if (humanJoints != null) {
        var map = new List<Native.HumanJoint>();
        foreach (KeyValuePair<string, int> entry in humanJoints)
          map.Add(new Native.HumanJoint { vrmName = kept.Text(entry.Key), joint = entry.Value });
        options.humanJointCount = map.Count;
        options.humanJoints = kept.Array(map.ToArray());
      }
      Native.Check(Native.panache_skeleton_create(native, native.Length, ref options,
                                                  out IntPtr skeleton));
      Handle = new Handle(skeleton, Native.panache_skeleton_destroy);
    }
    JointCount = Native.panache_skeleton_joint_count(Handle);
  }
  internal Skeleton(IntPtr skeleton) {
    Handle = new Handle(skeleton, Native.panache_skeleton_destroy);
    JointCount = Native.panache_skeleton_joint_count(Handle);
  }
  /// The index of the joint mapped to this human joint ("leftHand", VRM's names), or -1.
  public int Find(string humanJoint) =>
      Native.panache_skeleton_find(Handle, Native.Utf8(humanJoint));
  public void Dispose() => Handle.Dispose();
}

/// Scales the parts of what the styles do, 0 to 2 each; 1 is the style as the model has it.
[StructLayout(LayoutKind.Sequential)]
public sealed class Shape {
  private uint structSize = Native.SizeOf<Shape>();
  public float Strength = 1, Posture = 1, Dynamics = 1, Timing = 1;
  public float Legs = 1, Torso = 1, LeftArm = 1, RightArm = 1;
  public float FootLock = 1, HandContacts = 1;  // 0 to 1.
  // From calm (0) to lively (2): the input's own movement of torso, head and arms, without a style,
  // too.
  public float Energy = 1;
}

/// How a character is styled; see panache_character_options.
[StructLayout(LayoutKind.Sequential)]
public sealed class CharacterOptions {
  private uint structSize = Native.SizeOf<CharacterOptions>();
  public float EaseSeconds = 0.15f;       // A change of strength takes about this long; 0 to 10.
  public float SmoothingSeconds = 0.04f;  // Time constant of the filter on the change; 0 to 10.
  public int HoldFeet = 1;                // 1: planted feet are held in place.
  public int StyleRoot = 1;               // 1: root motion is styled too.
  public int SkipCycles = 0;              // 1: whole cycles are skipped or repeated to keep time.
  public double MaxLag = 0;               // Seconds the output may lag the input, 0 to 4.
  public double MaxLead = 0;              // Seconds the output may lead the input, 0 to 0.25.
  // m/s. Faster hips count as a jump, which resets the style. Bodies on vehicles need more; 0 or
  // infinity turns this off.
  public double MaxSpeed = 15;
  internal IntPtr remover;  // Set by UseRemover().
  /// A model that removes styles, for Character.SetRemoved(); it must outlive the creation of the
  /// character.
  public void UseRemover(Model model) => remover = model.Handle.DangerousGetHandle();
  // How often the active styles play their gestures, at random: 1 as often as the performers did, 0
  // not at all, up to 10 times as often.
  public float GestureRate = 1;
  public uint GestureSeed = 0;   // Characters with different seeds gesture at different times.
}

/// Measurements of the last step.
[StructLayout(LayoutKind.Sequential)]
public sealed class Report {
  private uint structSize = Native.SizeOf<Report>();
  public float Gate;  // 1: the input resembles the training motion; 0: out-of-distribution.
  public float LeftContact, RightContact;  // Probability that the foot is planted.
  public double Rate;   // Input seconds per output second that the style asks for.
  public double Ahead;  // Seconds by which the output leads the newest input; below 0: it lags.
}

/// One character in motion. Its arrays are allocated and pinned once; a step allocates nothing.
/// Use it from one thread at a time.
public sealed class Character : IDisposable {
  private readonly Handle handle;
  private readonly Model model;
  private readonly Pinned inRotations, inTranslations, outRotations, outTranslations;
  private readonly Native.Pose input, output;

  /// Input: fill these before a step. [joints * 4] x, y, z, w; [joints * 3]
  public float[] InputRotations { get; }
  public float[] InputTranslations { get; }
  /// Output of a step, in the same layout.
  public float[] Rotations { get; }
  public float[] Translations { get; }

  public Character(Model model, Skeleton skeleton, CharacterOptions options = null) {
    this.model = model;
    Native.Check(Native.panache_character_create(model.Handle, skeleton.Handle,
                                                 options ?? new CharacterOptions(),
                                                 out IntPtr character));
    handle = new Handle(character, Native.panache_character_destroy);
    InputRotations = new float[4 * skeleton.JointCount];
    InputTranslations = new float[3 * skeleton.JointCount];
    Rotations = new float[4 * skeleton.JointCount];
    Translations = new float[3 * skeleton.JointCount];
    for (int w = 3; w < InputRotations.Length; w += 4) InputRotations[w] = Rotations[w] = 1;
    inRotations = new Pinned(InputRotations);
    inTranslations = new Pinned(InputTranslations);
    outRotations = new Pinned(Rotations);
    outTranslations = new Pinned(Translations);
    input = new Native.Pose(inRotations, inTranslations);
    output = new Native.Pose(outRotations, outTranslations);
  }
  /// Styles the input, `seconds` after the last step. Cannot fail: the last good pose replaces
  /// non-finite values.
  public void Step(double seconds) => Native.panache_character_step(handle, input, seconds, output);
  /// 0 is off, 1 as captured, above 1 exaggerates; -4 to 4, eased over a few frames.
  public void SetStrength(string style, float strength) =>
      Native.panache_character_set_strength(handle, model.FindStyle(style), strength);
  /// 1 is as captured, -1 mirrored, 0 the mean of both; eased.
  public void SetSide(string style, float side) =>
      Native.panache_character_set_side(handle, model.FindStyle(style), side);
  /// The side that a word of Model.FindSide() names.
  public void SetSide(string style, string word) => SetSide(style, model.FindSide(style, word));
  /// Makes the character the person of a seed, in addition to its styles: 1 as far from the mean
  /// person as real people are, 0 nobody, at most 2; eased.
  public void SetPerson(uint seed, float amount = 1) =>
      Native.Check(Native.panache_character_set_person(handle, seed, amount));
  /// The same with a number for each of Model.PersonAxes.
  public void SetPerson(float[] numbers) => Native.Check(
      Native.panache_character_set_person_numbers(handle, numbers, numbers.Length));
  /// Removes a style from the input: its index in the model of UseRemover(), or -1 for none.
  public void SetRemoved(int style) =>
      Native.panache_character_set_removed(handle, style);
  /// Plays one of Model.Gestures(style) at the style's strength. Waits up to 3 seconds until no
  /// other gesture plays and a foot is on the floor; otherwise drops it.
  public void Trigger(string style, int gesture = 0) {
    if (Native.panache_character_trigger(handle, model.FindStyle(style), gesture) != 0) return;
    throw new PanacheException("style '" + style + "' has no gesture " + gesture + "; it has " +
                               model.Gestures(style).Count);
  }
  public void SetShape(Shape shape) =>
      Native.Check(Native.panache_character_set_shape(handle, shape));
  /// Forgets the motion so far; keeps strengths and sides.
  public void Reset() => Native.panache_character_reset(handle);
  public Report Report() {
    var report = new Report();
    Native.Check(Native.panache_character_get_report(handle, report));
    return report;
  }
  /// The character's state, to return to this moment. Not a file format.
  public byte[] Save() {
    var state = new byte[(int)Native.panache_character_state_size(handle)];
    Native.panache_character_save(handle, state);
    return state;
  }
  /// Continues, bit for bit, from a state saved with the same model, skeleton and options.
  public void Restore(byte[] state) =>
      Native.Check(Native.panache_character_restore(handle, state, (UIntPtr)state.Length));
  public void Dispose() {
    handle.Dispose();  // Before the arrays that it writes to.
    foreach (var array in new[] { inRotations, inTranslations, outRotations, outTranslations })
      array.Dispose();
  }
}

/// Motion of a rig at a constant rate.
public sealed class Clip {
  public Skeleton Skeleton;
  public double FrameSeconds = 1.0 / 30;
  public float[] Rotations;     // [frames * joints * 4]
  public float[] Translations;  // [frames * joints * 3]
  public int FrameCount => Rotations.Length / (4 * Skeleton.JointCount);

  /// Loads a motion of a BVH, GLB, glTF, VRM or FBX file, by default the first that moves the humanoid.
  /// Pass framesPerSecond if the file's rate is wrong or missing.
  public static Clip Load(string path, int? motion = null, double? framesPerSecond = null) {
    byte[] bytes = File.ReadAllBytes(path);
    IntPtr created;
    Native.Check(framesPerSecond.HasValue
        ? Native.panache_motion_file_create_at_rate(bytes, (UIntPtr)bytes.Length,
                                                    Native.Utf8(path), framesPerSecond.Value,
                                                    out created)
        : Native.panache_motion_file_create(bytes, (UIntPtr)bytes.Length, Native.Utf8(path),
                                            out created));
    using (var file = new Handle(created, Native.panache_motion_file_destroy)) {
      int which = motion ?? FirstOfTheBody(file, path);
      Native.Check(Native.panache_motion_file_get_clip(file, which, out Native.Clip found));
      Native.Check(Native.panache_motion_file_create_skeleton(file, which, IntPtr.Zero,
                                                              out IntPtr skeleton));
      var clip = new Clip { Skeleton = new Skeleton(skeleton), FrameSeconds = found.frameSeconds };
      clip.Rotations = new float[4 * found.frameCount * clip.Skeleton.JointCount];
      clip.Translations = new float[3 * found.frameCount * clip.Skeleton.JointCount];
      Marshal.Copy(found.rotations, clip.Rotations, 0, clip.Rotations.Length);
      Marshal.Copy(found.translations, clip.Translations, 0, clip.Translations.Length);
      return clip;
    }
  }
  static int FirstOfTheBody(Handle file, string path) {
    int count = Native.panache_motion_file_clip_count(file);
    for (int i = 0; i < count; ++i) {
      if (Native.panache_motion_file_clip_moves(file, i) != 0) return i;
    }
    if (count == 0) return 0;  // The library reports this.
    throw new PanacheException(path + ": none of its motions moves a joint of the humanoid; " +
                               "expected an animation that does");
  }
  internal Native.Clip ToNative(Kept kept) {
    int values = 4 * Skeleton.JointCount * FrameCount;
    if (Rotations.Length != values || Translations.Length != values / 4 * 3)
      throw new PanacheException("clip: has " + Rotations.Length + " and " + Translations.Length +
                                 " numbers; expected 4 and 3 for each of " + Skeleton.JointCount +
                                 " joints in each frame");
    return new Native.Clip {
      skeleton = Skeleton.Handle.DangerousGetHandle(), frameCount = FrameCount,
      frameSeconds = FrameSeconds, rotations = kept.Array(Rotations),
      translations = kept.Array(Translations)
    };
  }
}

/// A model with a newly learnt style, and a report on the learning.
public sealed class Learnt {
  /// The bytes of the model with the style, for new Model() or for saving.
  public byte[] ModelFile { get; private set; }
  /// Warnings about the clips.
  public IReadOnlyList<string> Warnings { get; private set; }
  /// Whether the clips are long enough to hold out a quarter of each. If so, the mean joint errors
  /// there, in centimetres: with the style, and of the neutral motion.
  public bool WasTested { get; private set; }
  public double HeldBackCm { get; private set; }
  public double UntouchedCm { get; private set; }
  /// "good", "fair" or "poor" by these errors; "poor" is no better than the neutral motion. ""
  /// if not tested.
  public string Verdict { get; private set; }

  /// For LearnAlone(), otherwise 0: the number of people whose mean replaces the neutral clip, and
  /// the share of the difference in posture that counts as style rather than as personal variation.
  public int People { get; private set; }
  public double Certainty { get; private set; }

  /// Learns the style `name` from one action, performed neutrally and in the style on one skeleton:
  /// 2 to 3 seconds of a walk, or a whole gesture. Replaces a style of this name only if `replace`.
  /// Does not change the model.
  public static Learnt Learn(Model model, string name, Clip neutral, Clip styled,
                             bool replace = false) {
    using (var kept = new Kept()) {
      var pairs = new[] { new Native.Pair { neutral = neutral.ToNative(kept),
                                            styled = styled.ToNative(kept) } };
      Native.Check(Native.panache_learn(model.File, (UIntPtr)model.File.Length, pairs, 1,
                                        Native.Utf8(name), replace ? 1 : 0, out IntPtr created));
      GC.KeepAlive(neutral);
      GC.KeepAlive(styled);
      return Take(created);
    }
  }

  /// Like Learn(), but from the styled clip alone: the mean motion of other people replaces the
  /// neutral clip. `bank` is the content of models/neutral.safetensors.
  public static Learnt LearnAlone(Model model, byte[] bank, string name, Clip styled,
                                  bool replace = false) {
    using (var kept = new Kept()) {
      Native.Clip clip = styled.ToNative(kept);
      Native.Check(Native.panache_learn_alone(
          model.File, (UIntPtr)model.File.Length, bank, (UIntPtr)bank.Length, ref clip,
          Native.Utf8(name), replace ? 1 : 0, out IntPtr created));
      GC.KeepAlive(styled);
      return Take(created);
    }
  }

  private static Learnt Take(IntPtr created) {
    using (var learnt = new Handle(created, Native.panache_learnt_destroy)) {
      var report = new Native.LearntReport { structSize = Native.SizeOf<Native.LearntReport>() };
      Native.Check(Native.panache_learnt_get_report(learnt, ref report));
      IntPtr data = Native.panache_learnt_model(learnt, out UIntPtr size);
      var file = new byte[(int)size];
      Marshal.Copy(data, file, 0, file.Length);
      return new Learnt {
        ModelFile = file,
        Warnings = Native.Text(report.warnings).Split(new[] { '\n' },
                                                      StringSplitOptions.RemoveEmptyEntries),
        WasTested = report.wasTested != 0, HeldBackCm = report.heldBackCm,
        UntouchedCm = report.untouchedCm, Verdict = Native.Text(Native.panache_learnt_verdict(learnt)),
        People = report.people, Certainty = report.certainty
      };
    }
  }
}

/// Owns an object of the library.
internal sealed class Handle : SafeHandle {
  private readonly Action<IntPtr> destroy;
  public Handle(IntPtr pointer, Action<IntPtr> destroy) : base(IntPtr.Zero, true) {
    this.destroy = destroy;
    SetHandle(pointer);
  }
  public override bool IsInvalid => handle == IntPtr.Zero;
  protected override bool ReleaseHandle() {
    destroy(handle);
    return true;
  }
}

/// A pinned array.
internal sealed class Pinned : IDisposable {
  private GCHandle pin;
  public Pinned(Array array) { pin = GCHandle.Alloc(array, GCHandleType.Pinned); }
  public IntPtr Address => pin.AddrOfPinnedObject();
  public void Dispose() {
    if (pin.IsAllocated) pin.Free();
    GC.SuppressFinalize(this);
  }
  ~Pinned() { Dispose(); }
}

/// Keeps what a call points to alive and pinned until it returns.
internal sealed class Kept : IDisposable {
  private readonly List<Pinned> arrays = new List<Pinned>();
  public IntPtr Array(Array array) {
    arrays.Add(new Pinned(array));
    return arrays[arrays.Count - 1].Address;
  }
  public IntPtr Text(string text) => Array(Native.Utf8(text));
  public void Dispose() {
    foreach (Pinned array in arrays) array.Dispose();
  }
}

/// The C interface (include/panache/panache.h).
internal static class Native {
  private const string Library = "panache";
  private const int Version = 2;  // 100 * major + minor of the header that these structs mirror.

  static Native() {
    int found = panache_version() / 100;
    if (found != Version)
      throw new PanacheException("the library is version " + found / 100 + "." + found % 100 +
                                 "; expected " + Version / 100 + "." + Version % 100);
  }

  internal static void Check(int status) {
    if (status != 0) throw LastError();
  }
  internal static PanacheException LastError() =>
    new PanacheException(Text(panache_last_error()), (ErrorKind)panache_last_error_kind());
  internal static uint SizeOf<T>() => (uint)Marshal.SizeOf(typeof(T));
  internal static byte[] Utf8(string text) => Encoding.UTF8.GetBytes(text + "\0");
  internal static string Text(IntPtr utf8) {
    if (utf8 == IntPtr.Zero) return "";
    int size = 0;
    while (Marshal.ReadByte(utf8, size) != 0) ++size;
    var bytes = new byte[size];
    Marshal.Copy(utf8, bytes, 0, size);
    return Encoding.UTF8.GetString(bytes);
  }

  [StructLayout(LayoutKind.Sequential)]
  internal struct StyleInfo {
    public uint structSize;
    public int takesOff, isLearnt, hasSides, gestureCount;
    public IntPtr description, group, words, side, thumbnail;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct Joint {
    public IntPtr name;
    public int parent;
    public float x, y, z, w, tx, ty, tz;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct HumanJoint {
    public IntPtr vrmName;
    public int joint;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct SkeletonOptions {
    public uint structSize;
    public float metresPerUnit;
    public IntPtr upAxis, rotations, translations;
    public int poseCount, humanJointCount;
    public IntPtr humanJoints;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct Pose {
    public IntPtr rotations, translations;
    public Pose(Pinned rotations, Pinned translations) {
      this.rotations = rotations.Address;
      this.translations = translations.Address;
    }
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct Clip {
    public IntPtr skeleton;
    public int frameCount;
    public double frameSeconds;
    public IntPtr rotations, translations;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct Pair {
    public Clip neutral, styled;
  }
  [StructLayout(LayoutKind.Sequential)]
  internal struct LearntReport {
    public uint structSize;
    public int wasTested;
    public IntPtr warnings;
    public double heldBackCm, meanPostureCm, untouchedCm;
    public int people, isKnown;
    public double certainty;
  }

  [DllImport(Library)] internal static extern int panache_version();
  [DllImport(Library)] internal static extern IntPtr panache_last_error();
  [DllImport(Library)] internal static extern int panache_last_error_kind();
  [DllImport(Library)]
  internal static extern int panache_model_create(byte[] bytes, UIntPtr size, out IntPtr model);
  [DllImport(Library)] internal static extern void panache_model_destroy(IntPtr model);
  [DllImport(Library)] internal static extern int panache_model_style_count(Handle model);
  [DllImport(Library)]
  internal static extern IntPtr panache_model_style_name(Handle model, int style);
  [DllImport(Library)]
  internal static extern int panache_model_get_style_info(Handle model, int style,
                                                          ref StyleInfo info);
  [DllImport(Library)]
  internal static extern int panache_model_find_side(Handle model, int style, byte[] word,
                                                     out float side);
  [DllImport(Library)]
  internal static extern IntPtr panache_model_gesture_name(Handle model, int style, int gesture);
  [DllImport(Library)]
  internal static extern int panache_model_find_style(Handle model, byte[] name);
  [DllImport(Library)]
  internal static extern int panache_skeleton_create([In] Joint[] joints, int count,
                                                     ref SkeletonOptions options,
                                                     out IntPtr skeleton);
  [DllImport(Library)] internal static extern void panache_skeleton_destroy(IntPtr skeleton);
  [DllImport(Library)] internal static extern int panache_skeleton_joint_count(Handle skeleton);
  [DllImport(Library)]
  internal static extern int panache_skeleton_find(Handle skeleton, byte[] humanJoint);
  [DllImport(Library)]
  internal static extern int panache_character_create(Handle model, Handle skeleton,
                                                      CharacterOptions options,
                                                      out IntPtr character);
  [DllImport(Library)] internal static extern void panache_character_destroy(IntPtr character);
  [DllImport(Library)]
  internal static extern void panache_character_set_removed(Handle character, int style);
  [DllImport(Library)]
  internal static extern void panache_character_set_strength(Handle character, int style,
                                                             float strength);
  [DllImport(Library)]
  internal static extern void panache_character_set_side(Handle character, int style, float side);
  [DllImport(Library)]
  internal static extern int panache_character_set_person(Handle character, uint seed,
                                                          float amount);
  [DllImport(Library)]
  internal static extern int panache_character_set_person_numbers(Handle character,
                                                                  float[] numbers, int count);
  [DllImport(Library)]
  internal static extern int panache_model_person_axis_count(Handle model);
  [DllImport(Library)]
  internal static extern IntPtr panache_model_person_axis_name(Handle model, int axis);
  [DllImport(Library)]
  internal static extern uint panache_person_seed(byte[] word);
  [DllImport(Library)]
  internal static extern int panache_character_trigger(Handle character, int style, int gesture);
  [DllImport(Library)]
  internal static extern int panache_character_set_shape(Handle character, Shape shape);
  [DllImport(Library)]
  internal static extern void panache_character_step(Handle character, Pose input, double seconds,
                                                     Pose output);
  [DllImport(Library)] internal static extern void panache_character_reset(Handle character);
  [DllImport(Library)]
  internal static extern int panache_character_get_report(Handle character, [In, Out] Report report);
  [DllImport(Library)]
  internal static extern UIntPtr panache_character_state_size(Handle character);
  [DllImport(Library)]
  internal static extern void panache_character_save(Handle character, [Out] byte[] state);
  [DllImport(Library)]
  internal static extern int panache_character_restore(Handle character, byte[] state,
                                                       UIntPtr size);
  [DllImport(Library)]
  internal static extern int panache_motion_file_create(byte[] bytes, UIntPtr size, byte[] name,
                                                        out IntPtr file);
  [DllImport(Library)]
  internal static extern int panache_motion_file_create_at_rate(byte[] bytes, UIntPtr size,
                                                                byte[] name, double fps,
                                                                out IntPtr file);
  [DllImport(Library)] internal static extern void panache_motion_file_destroy(IntPtr file);
  [DllImport(Library)] internal static extern int panache_motion_file_clip_count(Handle file);
  [DllImport(Library)]
  internal static extern int panache_motion_file_clip_moves(Handle file, int motion);
  [DllImport(Library)]
  internal static extern int panache_motion_file_get_clip(Handle file, int motion, out Clip clip);
  [DllImport(Library)]
  internal static extern int panache_motion_file_create_skeleton(Handle file, int motion,
                                                                 IntPtr options,
                                                                 out IntPtr skeleton);
  [DllImport(Library)]
  internal static extern int panache_learn(byte[] model, UIntPtr size, [In] Pair[] pairs, int count,
                                           byte[] name, int replace, out IntPtr learnt);
  [DllImport(Library)]
  internal static extern int panache_learn_alone(byte[] model, UIntPtr modelSize, byte[] bank,
                                                 UIntPtr bankSize, ref Clip styled, byte[] name,
                                                 int replace, out IntPtr learnt);
  [DllImport(Library)] internal static extern void panache_learnt_destroy(IntPtr learnt);
  [DllImport(Library)]
  internal static extern IntPtr panache_learnt_model(Handle learnt, out UIntPtr size);
  [DllImport(Library)]
  internal static extern IntPtr panache_learnt_verdict(Handle learnt);
  [DllImport(Library)]
  internal static extern int panache_learnt_get_report(Handle learnt, ref LearntReport report);
}

}  // namespace Panache
