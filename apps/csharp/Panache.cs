// Panache for C#: gives the motion of a character a style, live. One file over the shared library
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
// Rotations are unit quaternions x, y, z, w and translations three numbers, both of a joint relative
// to its parent, in the units and axes of the skeleton itself (any right-handed ones). Joints stand
// in the order in which the skeleton was given, parents before children. Whatever fails throws a
// PanacheException with the library's own sentence. Needs C# 7 and no unsafe code.

using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using System.Text;

namespace Panache {

/// What the library says of bad input, in one sentence.
public sealed class PanacheException : Exception {
  /// What kind of mistake it is, for programs that help with it.
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

/// A trained model: its styles and networks. Never changes; may be used by any number of threads.
public sealed class Model : IDisposable {
  internal readonly Handle Handle;
  /// The bytes of its file (.safetensors).
  public byte[] File { get; }
  /// The names of its styles, in the model's order.
  public IReadOnlyList<string> Styles { get; }
  /// What each of them is listed under, "moods"; "" for learnt ones, and in models without groups.
  public IReadOnlyList<string> Groups { get; }
  /// The gestures of a style, "head turns left, 1.2 s", for Character.Trigger(); most styles have
  /// none.
  public IReadOnlyList<string> Gestures(string style) {
    int place = FindStyle(style);
    var names = new List<string>();
    for (int k = 0; k < Native.panache_model_gesture_count(Handle, place); ++k) {
      names.Add(Native.Text(Native.panache_model_gesture_name(Handle, place, k)));
    }
    return names;
  }

  public Model(byte[] file) {
    File = file;
    Native.Check(Native.panache_model_create(file, (UIntPtr)file.Length, out IntPtr model));
    Handle = new Handle(model, Native.panache_model_destroy);
    var styles = new List<string>();
    var groups = new List<string>();
    for (int i = 0; i < Native.panache_model_style_count(Handle); ++i) {
      styles.Add(Native.Text(Native.panache_model_style_name(Handle, i)));
      groups.Add(Native.Text(Native.panache_model_style_group(Handle, i)));
    }
    Styles = styles;
    Groups = groups;
  }
  public static Model Load(string path) => new Model(System.IO.File.ReadAllBytes(path));
  /// The place of a style; throws where the model has none of that name.
  public int FindStyle(string name) {
    int place = Native.panache_model_find_style(Handle, Native.Utf8(name));
    if (place >= 0) return place;
    throw new PanacheException("unknown style '" + name + "'; the model has " +
                               (Styles.Count > 0 ? string.Join(", ", Styles) : "no styles yet"));
  }
  public void Dispose() => Handle.Dispose();
}

/// One joint of a skeleton: its rest transform relative to its parent, which stands before it; the
/// parent of a root is -1.
public sealed class Joint {
  public string Name = "";
  public int Parent = -1;
  public float[] Rotation = { 0, 0, 0, 1 };    // x, y, z, w
  public float[] Translation = { 0, 0, 0 };
}

/// A rig, and which of its joints are a humanoid's, found by their names and shape. Never changes.
public sealed class Skeleton : IDisposable {
  internal readonly Handle Handle;
  public int JointCount { get; }

  /// upAxis: "+Y", "-Z", ..., and metresPerUnit; null and 0: found. humanJoints: the place of each
  /// joint of the humanoid ("leftHand", VRM's names), -1 where the rig has none; what it does not
  /// list is found.
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
  /// The place of the joint that is this joint of the humanoid ("leftHand", VRM's names), or -1.
  public int Find(string humanJoint) =>
      Native.panache_skeleton_find(Handle, Native.Utf8(humanJoint));
  public void Dispose() => Handle.Dispose();
}

/// How much is given of what the styles do, 0 to 2 each; 1 is the style as the model has it.
[StructLayout(LayoutKind.Sequential)]
public sealed class Shape {
  private uint structSize = Native.SizeOf<Shape>();
  public float Strength = 1, Posture = 1, Dynamics = 1, Timing = 1;
  public float Legs = 1, Torso = 1, LeftArm = 1, RightArm = 1;
  public float FootLock = 1;  // 0 to 1.
}

/// How a character is styled, as panache_character_options.
[StructLayout(LayoutKind.Sequential)]
public sealed class CharacterOptions {
  private uint structSize = Native.SizeOf<CharacterOptions>();
  public float EaseSeconds = 0.15f;       // A change of strength takes about this long; 0 to 10.
  public float SmoothingSeconds = 0.04f;  // Of the filter on what a style adds; 0 to 10.
  public int HoldFeet = 1;                // 1: planted feet are held in place.
  public int StyleRoot = 1;               // 1: root motion is styled too.
  public int SkipCycles = 0;              // 1: whole cycles are skipped or repeated to keep time.
  public double MaxLag = 0;               // Seconds behind the input, 0 to 4,
  public double MaxLead = 0;              // and ahead of it, 0 to 0.25, that a tempo may take.
  // m/s; faster hips have jumped, and the style starts afresh. Bodies on vehicles need more; 0 or
  // infinity: nothing is a jump.
  public double MaxSpeed = 15;
  internal IntPtr remover;  // Set by UseRemover().
  /// A model that takes styles off, for Character.SetRemoved(); it must live until the character is
  /// made.
  public void UseRemover(Model model) => remover = model.Handle.DangerousGetHandle();
  public float GestureRate = 0;  // Gestures of the active styles at random, per second, 0 to 10;
  public uint GestureSeed = 0;   // characters with different seeds make them at different times.
}

/// What went on at the last step.
[StructLayout(LayoutKind.Sequential)]
public sealed class Report {
  private uint structSize = Native.SizeOf<Report>();
  public float Gate;  // 1: motion like what the model knows; 0: unlike.
  public float LeftContact, RightContact;  // Probability that the foot is planted.
  public double Rate;   // Seconds of input that the style would take per second.
  public double Ahead;  // Seconds from the newest input to what is shown; below 0: it is late.
}

/// One character in motion. Its arrays are made once and stay where they are in memory, so that a
/// step allocates nothing. One thread at a time.
public sealed class Character : IDisposable {
  private readonly Handle handle;
  private readonly Model model;
  private readonly Pinned inRotations, inTranslations, outRotations, outTranslations;
  private readonly Native.Pose input, output;

  /// Fill these before a step. [joints * 4] x, y, z, w; [joints * 3]
  public float[] InputRotations { get; }
  public float[] InputTranslations { get; }
  /// What a step gives, likewise.
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
  /// Styles the input; `seconds` have gone by since the last step. Cannot fail: numbers that are not
  /// finite are replaced by the last good pose.
  public void Step(double seconds) => Native.panache_character_step(handle, input, seconds, output);
  /// 0 not at all, 1 as captured, more exaggerates; -4 to 4, eased over a few frames.
  public void SetStrength(string style, float strength) =>
      Native.panache_character_set_strength(handle, model.FindStyle(style), strength);
  /// Takes a style off the input: its index in the model of CharacterOptions.UseRemover(); -1: none.
  public void SetRemoved(int style) =>
      Native.panache_character_set_removed(handle, style);
  /// Plays one of Model.Gestures(style) on top of the style, as strongly as that acts: when no other
  /// plays and a foot is on the floor, within 3 seconds or not at all.
  public void Trigger(string style, int gesture = 0) {
    if (Native.panache_character_trigger(handle, model.FindStyle(style), gesture) != 0) return;
    throw new PanacheException("style '" + style + "' has no gesture " + gesture + "; it has " +
                               model.Gestures(style).Count);
  }
  public void SetShape(Shape shape) =>
      Native.Check(Native.panache_character_set_shape(handle, shape));
  /// Forgets the motion so far; strengths stay.
  public void Reset() => Native.panache_character_reset(handle);
  public Report Report() {
    var report = new Report();
    Native.Check(Native.panache_character_get_report(handle, report));
    return report;
  }
  /// The character's memory, to return to this moment: for memory, not for files.
  public byte[] Save() {
    var state = new byte[(int)Native.panache_character_state_size(handle)];
    Native.panache_character_save(handle, state);
    return state;
  }
  /// Goes on bit for bit from where a character of the same model, skeleton and options was saved.
  public void Restore(byte[] state) =>
      Native.Check(Native.panache_character_restore(handle, state, (UIntPtr)state.Length));
  public void Dispose() {
    handle.Dispose();  // Before what it writes to.
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

  /// A motion of a BVH, GLB, glTF or VRM file, the first that moves the humanoid where none is asked
  /// for; framesPerSecond where its rate is wrong or missing.
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
    if (count == 0) return 0;  // The library says so.
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

/// A model that has learnt a style, and how well that went.
public sealed class Learnt {
  /// The file of the model with the style, for new Model() and for disk.
  public byte[] ModelFile { get; private set; }
  /// Sentences about the clips.
  public IReadOnlyList<string> Warnings { get; private set; }
  /// Whether the clips are long enough to hold a quarter of each back; then the mean distances of
  /// the joints there, in centimetres: of the style, and of the neutral motion as it is.
  public bool WasTested { get; private set; }
  public double HeldBackCm { get; private set; }
  public double UntouchedCm { get; private set; }
  /// By these distances "good", "fair", or "poor" where the style is no better than the neutral
  /// motion; "" where it was not tested.
  public string Verdict { get; private set; }

  /// Of LearnAlone(), otherwise 0: the people whose mean takes the neutral clip's place, and the
  /// share of the difference in posture that counts as style, not as what people differ by.
  public int People { get; private set; }
  public double Certainty { get; private set; }

  /// Learns the style `name` from one action, done neutrally and in the style, by one skeleton: 2 to
  /// 3 seconds of a walk, or the whole of a gesture. A style of this name is replaced only where
  /// `replace`. The model stays as it is.
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

  /// As Learn(), from a clip in the style alone: how other people move takes the place of the
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

/// An object of the library, destroyed when it is no longer used.
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

/// An array that stays where it is in memory.
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

/// What a call points to, until it is over.
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
  private const int Version = 2;  // 0.2: major times 100 and minor, of the header of these structs.

  static Native() {
    int found = panache_version() / 100;
    if (found != Version)
      throw new PanacheException("the library is version " + found / 100 + "." + found % 100 +
                                 "; expected " + Version / 100 + "." + Version % 100);
  }

  internal static void Check(int status) {
    if (status != 0) {
      throw new PanacheException(Text(panache_last_error()), (ErrorKind)panache_last_error_kind());
    }
  }
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
  internal static extern IntPtr panache_model_style_group(Handle model, int style);
  [DllImport(Library)]
  internal static extern int panache_model_gesture_count(Handle model, int style);
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
