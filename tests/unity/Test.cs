// Test.exe MODEL WALK.bvh WITHOUT: the component of the Unity package on stand-ins of Unity's types,
// against the library's own steps. WALK.bvh is what `panache walker` writes: its joints have VRM's
// names. WITHOUT is a model without persons.

using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using Panache.Unity;
using UnityEngine;

static class Test {
  static void Expect(bool holds, string what) {
    if (holds) return;
    Console.Error.WriteLine("failed: " + what);
    Environment.Exit(1);
  }

  // ---- A walk, right-handed as the library has it ----------------------------------------------

  static readonly List<string> names = new List<string>();
  static readonly List<int> parents = new List<int>();
  static readonly List<float[]> offsets = new List<float[]>();
  static Panache.Clip walk;

  static void ReadWalk(string path) {
    walk = Panache.Clip.Load(path);
    var open = new Stack<int>();
    int joint = -1;
    foreach (string line in File.ReadLines(path)) {
      string[] words = line.Split(new[] { ' ' }, StringSplitOptions.RemoveEmptyEntries);
      if (words[0] == "MOTION") break;
      if (words[0] == "ROOT" || words[0] == "JOINT") {
        names.Add(words[1]);
        parents.Add(open.Count > 0 ? open.Peek() : -1);
        joint = names.Count - 1;
      } else if (words[0] == "End") {
        joint = -1;
      } else if (words[0] == "{") {
        open.Push(joint);
      } else if (words[0] == "}") {
        open.Pop();
      } else if (words[0] == "OFFSET" && joint >= 0) {
        offsets.Add(words.Skip(1).Select(float.Parse).ToArray());
      }
    }
    Expect(names.Count == walk.Skeleton.JointCount, "the joints of the walk");
  }

  // ---- A character of Unity --------------------------------------------------------------------

  static Vector3 Mirror(float[] v, int at = 0) => new Vector3(-v[at], v[at + 1], v[at + 2]);
  static Quaternion Mirror4(float[] q, int at) =>
      new Quaternion(q[at], -q[at + 1], -q[at + 2], q[at + 3]);

  // A character whose hips are below its Animator's transform, or below an armature of that scale;
  // with names that say nothing of the joints.
  sealed class Actor {
    public readonly Animator Animator;
    public readonly Transform[] Bones;
    public readonly PanacheCharacter Component;
    public readonly float Scale;
    public bool Culled;
    public bool HasChest => Animator.GetBoneTransform(HumanBodyBones.Chest) != null ||
                            Animator.GetBoneTransform(HumanBodyBones.UpperChest) != null;
    public Actor(TextAsset model, float scale = 1, Func<HumanBodyBones, HumanBodyBones> rename = null,
                 float old = 0) {
      Scale = scale;
      var root = new GameObject("actor");
      Animator = root.AddComponent<Animator>();
      Transform below = root.transform;
      if (scale != 1) {
        below = new GameObject("armature").transform;
        below.parent = root.transform;
        below.localScale = new Vector3(scale, scale, scale);
      }
      Bones = new Transform[names.Count];
      for (int j = 0; j < Bones.Length; ++j) {
        Bones[j] = new GameObject("x" + (7 * j) % 22).transform;
        Bones[j].parent = j == 0 ? below : Bones[parents[j]];
        Vector3 offset = Mirror(offsets[j]);
        Bones[j].localPosition = new Vector3(offset.x / scale, offset.y / scale, offset.z / scale);
        var bone = (HumanBodyBones)Enum.Parse(typeof(HumanBodyBones), names[j], true);
        Animator.Bones[rename == null ? bone : rename(bone)] = Bones[j];
      }
      var prop = new GameObject("leftHand").transform;  // No bone, whatever its name.
      prop.parent = Bones[names.IndexOf("rightHand")];
      Component = root.AddComponent<PanacheCharacter>();
      Component.model = model;
      if (old != 0) Component.SetStrength("Old", old);
    }
    public void Call(string message) => typeof(PanacheCharacter)
        .GetMethod(message, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(Component, null);
    public Actor Start() {
      Call("Awake");
      if (Component.enabled) Call("OnEnable");
      return this;
    }
    // The animation: root motion carries the Animator's transform over the ground.
    public void Animate(int frame, float height = 0) {
      int r = 4 * names.Count * frame, p = 3 * names.Count * frame;
      Vector3 hips = Mirror(walk.Translations, p);
      Animator.transform.localPosition = new Vector3(hips.x, height, hips.z);
      if (Culled) return;
      Bones[0].localPosition = new Vector3(0, hips.y / Scale, 0);
      for (int j = 0; j < Bones.Length; ++j) Bones[j].localRotation = Mirror4(walk.Rotations, r + 4 * j);
    }
    public float[] Pose() {
      var pose = new List<float>();
      foreach (Transform bone in Bones) {
        Quaternion q = bone.localRotation;
        Vector3 p = bone.localPosition;
        pose.AddRange(new[] { q.x, q.y, q.z, q.w, p.x * Scale, p.y * Scale, p.z * Scale });
      }
      return pose.ToArray();
    }
    public float[] Play(int frame, float height = 0) {
      Animate(frame, height);
      Call("LateUpdate");
      return Pose();
    }
    public Transform this[string joint] => Bones[names.IndexOf(joint)];
  }

  // What the library itself makes of the same walk below the same root, and that mirrored.
  sealed class Reference {
    public readonly Panache.Character Character;
    public Reference(Panache.Model model, float old = 0, bool styleRoot = false) {
      var joints = new List<Panache.Joint> { new Panache.Joint { Name = "root" } };
      for (int j = 0; j < names.Count; ++j)
        joints.Add(new Panache.Joint { Name = names[j], Parent = parents[j] + 1,
                                       Translation = offsets[j] });
      Character = new Panache.Character(model, new Panache.Skeleton(joints),
                                        new Panache.CharacterOptions {
                                          HoldFeet = 1, StyleRoot = styleRoot ? 1 : 0
                                        });
      Character.SetStrength("old", old);
    }
    public float[] Play(int frame) {
      int count = names.Count;
      float[] r = Character.InputRotations, p = Character.InputTranslations;
      Array.Copy(walk.Rotations, 4 * count * frame, r, 4, 4 * count);
      for (int j = 1; j < count; ++j) Array.Copy(offsets[j], 0, p, 3 * (j + 1), 3);
      p[0] = walk.Translations[3 * count * frame];
      p[2] = walk.Translations[3 * count * frame + 2];
      p[3] = p[5] = 0;
      p[4] = walk.Translations[3 * count * frame + 1];
      Character.Step(Time.deltaTime);
      var pose = new List<float>();
      for (int j = 1; j <= count; ++j) {
        Quaternion q = Mirror4(Character.Rotations, 4 * j);
        Vector3 t = Mirror(Character.Translations, 3 * j);
        pose.AddRange(new[] { q.x, q.y, q.z, q.w, t.x, t.y, t.z });
      }
      return pose.ToArray();
    }
  }

  // The component has the library's pose in every frame, while `change` changes both alike before
  // some; how far that is from the pose of `plain`, at most.
  static float Follow(Actor actor, Reference reference, Reference plain, int frames, string what,
                      Action<int> change) {
    float apart = 0;
    for (int f = 0; f < frames; ++f) {
      change(f);
      float[] pose = reference.Play(f);
      Expect(actor.Play(f).SequenceEqual(pose), what + " in frame " + f);
      apart = Math.Max(apart, Apart(plain.Play(f), pose));
    }
    return apart;
  }

  static float Apart(float[] a, float[] b) => a.Zip(b, (x, y) => Math.Abs(x - y)).Max();

  // ---- Tests -----------------------------------------------------------------------------------

  static void AStyledWalkIsTheLibrarysMirrored(TextAsset file, Panache.Model model) {
    foreach (bool root in new[] { false, true }) {
      var actor = new Actor(file, old: 1);
      actor.Component.styleRoot = root;
      actor.Start();
      var reference = new Reference(model, 1, root);
      float away = 0;
      for (int f = 0; f < walk.FrameCount; ++f) {
        Expect(actor.Play(f, 12.5f).SequenceEqual(reference.Play(f)), "the library's pose in frame " + f);
        Vector3 hips = actor["hips"].localPosition;
        away = Math.Max(away, new Vector3(hips.x, 0, hips.z).magnitude);
      }
      Expect(root ? away > 0.3f : away < 0.15f, "hips that leave their GameObject by " + away + " m");
    }
  }

  static void AScaledArmatureIsStyledAlike(TextAsset file, Panache.Model model) {
    var actor = new Actor(file, 0.01f, old: 1).Start();
    var reference = new Reference(model, 1);
    for (int f = 0; f < walk.FrameCount; ++f)
      Expect(Apart(actor.Play(f), reference.Play(f)) < 1e-3f, "the same pose in frame " + f);
  }

  static void APoseIsMirroredAsTheGameIs(TextAsset file) {
    var actor = new Actor(file).Start();
    actor.Animate(60);
    // Unity's left is at -x, and the body faces +z.
    Expect(actor["leftHand"].position.x < actor["rightHand"].position.x, "left at -x");
    Vector3 before = actor["head"].position - actor["hips"].position;
    actor.Component.SetStrength("old", 1);
    actor.Component.shape.rightArm = 0;
    for (int f = 0; f <= 60; ++f) actor.Play(f);
    Vector3 after = actor["head"].position - actor["hips"].position;
    Expect(after.z > before.z + 0.03f, "old leans ahead, to +z, by " + (after.z - before.z));
    float[] raw = Raw(60);
    Expect(Same(actor, raw, "rightLowerArm") && !Same(actor, raw, "leftLowerArm"),
           "the right arm alone keeps its pose");
  }
  static float[] Raw(int frame) =>
      walk.Rotations.Skip(4 * names.Count * frame).Take(4 * names.Count).ToArray();
  static bool Same(Actor actor, float[] raw, string joint) {
    Quaternion q = Mirror4(raw, 4 * names.IndexOf(joint)), p = actor[joint].localRotation;
    return Math.Abs(q.x * p.x + q.y * p.y + q.z * p.z + q.w * p.w) > 1 - 1e-6f;
  }

  static void StrengthZeroChangesNoBit(TextAsset file) {
    var actor = new Actor(file, 0.01f).Start();
    for (int f = 0; f < 60; ++f) {
      actor.Animate(f);
      float[] before = actor.Pose();
      Expect(actor.Play(f).SequenceEqual(before), "no change without a style");
    }
  }

  static void APoseThatWasNotAnimatedIsNotStyledTwice(TextAsset file) {
    var actors = new[] { new Actor(file, old: 1).Start(), new Actor(file, old: 1).Start() };
    foreach (Actor actor in actors) {
      for (int f = 0; f < 60; ++f) actor.Play(f);
    }
    // One is animated as before, the other is not animated at all.
    actors[1].Culled = true;
    for (int f = 60; f < 120; ++f) {
      actors[0].Animate(59);
      actors[0].Animator.transform.localPosition = new Vector3(0, 0, f / 60f);
      actors[0].Call("LateUpdate");
      actors[1].Animate(59);
      actors[1].Animator.transform.localPosition = new Vector3(0, 0, f / 60f);
      actors[1].Call("LateUpdate");
      Expect(actors[0].Pose().SequenceEqual(actors[1].Pose()), "styled once in frame " + f);
    }
  }

  static void StrengthsAreAListThatMayChange(TextAsset file, Panache.Model model) {
    var actor = new Actor(file).Start();
    actor.Component.ListStyles();
    Expect(actor.Component.styles.Select(s => s.style).SequenceEqual(model.Styles), "all styles");
    actor.Component.styles.Clear();
    actor.Component.SetStrength("proud", 1);
    for (int f = 0; f < 60; ++f) actor.Play(f);
    Expect(!Same(actor, Raw(59), "spine"), "a style");
    actor.Component.styles.Clear();
    for (int f = 60; f < 239; ++f) actor.Play(f);
    Expect(Same(actor, Raw(238), "spine"), "none any more");
    actor.Component.SetStrength("odl", 1);
    actor.Component.styles.Add(new StyleStrength());
    actor.Component.styles.Add(new StyleStrength { style = null });
    actor.Play(0);
    actor.Play(1);
    Expect(Debug.Errors.Count == 1 && Debug.Errors[0].StartsWith("Panache: unknown style 'odl'") &&
           actor.Component.enabled, "an unknown style is told once");
    Debug.Errors.Clear();
  }

  static void SidesAreTheLibrarys(TextAsset file, Panache.Model model) {
    var actor = new Actor(file, old: 1);
    actor.Component.SetSide("OLD", -1);
    var reference = new Reference(model, 1);
    reference.Character.SetSide("old", -1);
    float apart = Follow(actor.Start(), reference, new Reference(model, 1), 120, "a side", f => {
      if (f != 60) return;
      actor.Component.SetSide("old", 0.5f);
      reference.Character.SetSide("old", 0.5f);
    });
    Expect(apart > 0.01f, "another side than the captured one");
    Expect(actor.Component.styles.Count == 1, "one entry for a style");
  }

  // A number, a word and nobody; a person who is changed while the character moves.
  static void PersonsAreTheLibrarys(TextAsset file, Panache.Model model) {
    var seeds = new Dictionary<string, uint> {
      { "7", 7 }, { " 007 ", 7 }, { "4294967295", uint.MaxValue }, { " mara", Seed("mara") },
      { "4294967296", Seed("4294967296") }, { "-7", Seed("-7") },
      { "7up", Seed("7up") }, { "+7", Seed("+7") }
    };
    foreach (var entry in seeds) {
      var actor = new Actor(file);
      actor.Component.person = entry.Key;
      actor.Start();
      var reference = new Reference(model);
      reference.Character.SetPerson(entry.Value);
      for (int f = 0; f < 20; ++f)
        Expect(actor.Play(f).SequenceEqual(reference.Play(f)),
               "person '" + entry.Key + "' in frame " + f);
    }
    var changing = new Actor(file).Start();
    var expected = new Reference(model);
    float apart = Follow(changing, expected, new Reference(model), 180, "the person", f => {
      if (f == 30) {
        changing.Component.person = "mara";
        changing.Component.variety = 1.5f;
        expected.Character.SetPerson(Seed("mara"), 1.5f);
      } else if (f == 90) {
        changing.Component.variety = 3;  // A script's; the inspector has a range.
        expected.Character.SetPerson(Seed("mara"), 2);
      } else if (f == 150) {
        changing.Component.person = null;
        expected.Character.SetPerson(0, 0);
      }
    });
    Expect(apart > 0.01f, "another person");
  }

  static uint Seed(string word) => Panache.Model.PersonSeed(word);

  static void EnergyIsTheLibrarys(TextAsset file, Panache.Model model) {
    var actor = new Actor(file).Start();
    var reference = new Reference(model);
    float apart = Follow(actor, reference, new Reference(model), 90, "an energy", f => {
      if (f % 60 != 0) return;
      actor.Component.shape.energy = f == 0 ? 0.3f : 1.7f;
      reference.Character.SetShape(new Panache.Shape { Energy = f == 0 ? 0.3f : 1.7f });
    });
    Expect(apart > 0.01f, "a calmer walk");
  }

  static void AModelWithoutPersonsIsToldOnce(TextAsset file, Panache.Model model) {
    string style = model.Styles[0];
    var actor = new Actor(file);
    actor.Component.SetStrength(style, 1);
    actor.Start();
    var reference = new Reference(model);
    reference.Character.SetStrength(style, 1);
    for (int f = 0; f < 60; ++f) {
      if (f == 20) {
        Expect(Debug.Errors.Count == 0, "no error without a person");
        actor.Component.person = "mara";
      }
      actor.Component.variety = f / 60f;
      if (f == 50) actor.Component.person = "";
      Expect(actor.Play(f).SequenceEqual(reference.Play(f)), "nobody, but the style, in frame " + f);
    }
    Expect(Debug.Errors.Count == 1 &&
               Debug.Errors[0].StartsWith("Panache: the model has no persons; expected ") &&
               actor.Component.enabled,
           "no persons are told once: " + string.Join("; ", Debug.Errors));
    Debug.Errors.Clear();
  }

  static void ATeleportStartsAfresh(TextAsset file, Panache.Model model) {
    var actor = new Actor(file, old: 1).Start();
    var fresh = new Reference(model, 1);
    for (int f = 0; f < 60; ++f) fresh.Play(f);
    for (int f = 0; f < 60; ++f) actor.Play(f);
    actor.Component.ResetMotion();
    fresh.Character.Reset();
    for (int f = 60; f < 100; ++f)
      Expect(actor.Play(f).SequenceEqual(fresh.Play(f)), "as after a reset");
    actor.Call("OnDisable");
    actor.Animate(50);
    float[] plain = actor.Pose();
    actor.Call("LateUpdate");
    Expect(actor.Pose().SequenceEqual(plain), "nothing while disabled");
    actor.Call("OnEnable");
    Expect(!actor.Play(50).SequenceEqual(plain), "styled again");
    actor.Call("OnDisable");
    actor.Call("OnDestroy");
  }

  // Avatars without a chest, or with an upper chest, and without what Unity lets be missing.
  static void AvatarsMayLackBones(TextAsset file) {
    Func<HumanBodyBones, HumanBodyBones> upper = bone =>
        bone == HumanBodyBones.Chest ? HumanBodyBones.UpperChest : bone;
    foreach (var rename in new[] { null, upper }) {
      foreach (var lacks in new[] { new[] { HumanBodyBones.LastBone }, new[] { HumanBodyBones.Chest },
                                    new[] { HumanBodyBones.Neck, HumanBodyBones.LeftShoulder,
                                            HumanBodyBones.RightShoulder },
                                    new[] { HumanBodyBones.LeftToes, HumanBodyBones.RightToes } }) {
        var actor = new Actor(file, 1, rename, old: 1);
        foreach (HumanBodyBones bone in lacks) actor.Animator.Bones.Remove(bone);
        actor.Start();
        Expect(actor.Component.enabled, "a humanoid without " + string.Join(", ", lacks) + ": " +
                                            string.Join("; ", Debug.Errors));
        for (int f = 0; f < 30; ++f) actor.Play(f);
        Expect(!Same(actor, Raw(29), "chest") || !actor.HasChest, "a styled chest");
        Expect(!Same(actor, Raw(29), "leftUpperArm"), "styled without " + string.Join(", ", lacks));
      }
    }
  }

  static void WhatIsMissingIsTold(TextAsset file) {
    var noAvatar = new Actor(file);
    noAvatar.Animator.isHuman = false;
    ExpectDisabled(noAvatar, "no humanoid avatar");
    ExpectDisabled(new Actor(null), "expected a model, found none");
    ExpectDisabled(new Actor(new TextAsset { bytes = new byte[] { 1, 2, 3 } }),
                   "expected a safetensors file");
    var noFoot = new Actor(file);
    noFoot.Animator.Bones.Remove(HumanBodyBones.LeftFoot);
    ExpectDisabled(noFoot, "leftFoot");
  }
  static void ExpectDisabled(Actor actor, string message) {
    actor.Start();
    Expect(!actor.Component.enabled && Debug.Errors.Single().Contains(message), message);
    Debug.Errors.Clear();
  }

  static int Main(string[] arguments) {
    var file = new TextAsset { name = "panache-int8", bytes = File.ReadAllBytes(arguments[0]) };
    Panache.Model model = Panache.Model.Load(arguments[0]);
    ReadWalk(arguments[1]);
    Time.deltaTime = (float)walk.FrameSeconds;
    AStyledWalkIsTheLibrarysMirrored(file, model);
    AScaledArmatureIsStyledAlike(file, model);
    APoseIsMirroredAsTheGameIs(file);
    StrengthZeroChangesNoBit(file);
    APoseThatWasNotAnimatedIsNotStyledTwice(file);
    StrengthsAreAListThatMayChange(file, model);
    SidesAreTheLibrarys(file, model);
    PersonsAreTheLibrarys(file, model);
    EnergyIsTheLibrarys(file, model);
    AModelWithoutPersonsIsToldOnce(
        new TextAsset { name = "without", bytes = File.ReadAllBytes(arguments[2]) },
        Panache.Model.Load(arguments[2]));
    ATeleportStartsAfresh(file, model);
    AvatarsMayLackBones(file);
    WhatIsMissingIsTold(file);
    Expect(Debug.Errors.Count == 0, "no error: " + string.Join("; ", Debug.Errors));
    Console.WriteLine("ok");
    return 0;
  }
}
