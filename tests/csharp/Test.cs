// Test.exe MODEL NEUTRAL.bvh STYLED.bvh POSES LIT LAMP BANK STRUCTS WITHOUT: C# against the C interface. POSES
// is what c_step wrote of NEUTRAL.bvh; LIT and LAMP are what lamp.py wrote; WITHOUT is a model without persons.

using System;
using System.Collections.Generic;
using System.Diagnostics;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;
using Panache;

static class Test {
  static void Expect(bool holds, string what) {
    if (holds) return;
    Console.Error.WriteLine("failed: " + what);
    Environment.Exit(1);
  }
  static string Rejection(Action action) {
    try {
      action();
    } catch (PanacheException error) {
      return error.Message;
    }
    return "(accepted)";
  }
  static void ExpectRejection(string begin, Action action) {
    string found = Rejection(action);
    Expect(found.StartsWith(begin), "expected '" + begin + "...', found '" + found + "'");
  }

  static void Load(Character character, Clip clip, int frame) {
    int rotations = character.InputRotations.Length, moves = character.InputTranslations.Length;
    Array.Copy(clip.Rotations, frame * rotations, character.InputRotations, 0, rotations);
    Array.Copy(clip.Translations, frame * moves, character.InputTranslations, 0, moves);
  }
  static byte[] Play(Character character, Clip clip, int begin, int end, List<double> times = null) {
    var bytes = new MemoryStream();
    var writer = new BinaryWriter(bytes);
    for (int f = begin; f < end; ++f) {
      Load(character, clip, f);
      long before = Stopwatch.GetTimestamp();
      character.Step(clip.FrameSeconds);
      times?.Add(1e6 * (Stopwatch.GetTimestamp() - before) / Stopwatch.Frequency);
      foreach (float x in character.Rotations) writer.Write(x);
      foreach (float x in character.Translations) writer.Write(x);
    }
    return bytes.ToArray();
  }

  // Of struct_sizes: name and size, then name and place of each field.
  static void StructsAreThoseOfTheHeader(string[] lines) {
    int seen = 0;
    foreach (string line in lines.Where(line => line != "")) {
      string[] words = line.Split(' ');
      string name = Camel(words[0]).Replace("InputPose", "Pose").Replace("OutputPose", "Pose");
      Type type = typeof(Model).Assembly.GetTypes().FirstOrDefault(
          one => one.Name == name && one.IsLayoutSequential);
      if (type == null) continue;  // C# has no use for it.
      ++seen;
      Expect(Marshal.SizeOf(type) == int.Parse(words[1]), "the size of " + name);
      for (int i = 2; i < words.Length; i += 2) {
        string field = char.ToLower(Camel(words[i])[0]) + Camel(words[i]).Substring(1);
        // Arrays are single numbers here.
        if (field == "rotation" || field == "translation" || field == "contacts") continue;
        FieldInfo found = type.GetFields(BindingFlags.Instance | BindingFlags.Public |
                                         BindingFlags.NonPublic).FirstOrDefault(
            one => one.Name.ToLower() == field.ToLower());
        Expect(found != null, name + " has a field " + field);
        Expect((int)Marshal.OffsetOf(type, found.Name) == int.Parse(words[i + 1]),
               "the place of " + name + "." + field);
      }
    }
    Expect(seen >= 10, "structs of the header, found " + seen);
  }
  static string Camel(string name) =>
      string.Concat(name.Split('_').Select(word => char.ToUpper(word[0]) + word.Substring(1)));

  static void StepsHaveTheBitsOfC(Model model, Clip walk, byte[] expected) {
    using (var character = new Character(model, walk.Skeleton)) {
      character.SetStrength("old", 1);
      var times = new List<double>();
      byte[] found = null;
      for (int turn = 0; turn < 20; ++turn) {
        character.Reset();
        found = Play(character, walk, 0, walk.FrameCount, times);
        GC.Collect();  // The arrays stay where they are.
      }
      Expect(found.SequenceEqual(expected), "the bits of C");
      times.Sort();
      Console.WriteLine("a step from Mono: {0:F2} us (median)", times[times.Count / 2]);
    }
  }

  // What a character makes of a second of the walk after a change of it.
  static byte[] Walked(Model model, Clip walk, Action<Character> change) {
    using (var character = new Character(model, walk.Skeleton)) {
      change(character);
      return Play(character, walk, 0, 60);
    }
  }
  // Each of these changes gives other motion than those before it; each of `same`, the last one's.
  static void ExpectMotions(Model model, Clip walk, string what, Action<Character>[] other,
                            params Action<Character>[] same) {
    var motions = other.Select(change => Walked(model, walk, change)).ToList();
    for (int i = 0; i < motions.Count; ++i)
      Expect(!motions.Take(i).Any(motions[i].SequenceEqual), "other motion of " + what + ", " + i);
    foreach (var change in same)
      Expect(Walked(model, walk, change).SequenceEqual(motions.Last()),
        "the same motion of " + what);
  }

  // What these do is tested over the C interface: that they get there, here.
  static void StylesHaveSides(Model model, Clip walk) {
    Expect(model.Sides.Count == model.Styles.Count, "a side, or none, for each style");
    Expect(model.FindSide("old", "captured") == 1 && model.FindSide("old", "mirrored") == -1,
           "words for sides");
    Action<Character> captured = one => one.SetStrength("old", 1);
    ExpectMotions(model, walk, "sides",
                  new[] { captured, captured + (one => one.SetSide("old", "mirrored")) },
                  captured + (one => one.SetSide("old", -1)));
  }

  static void PersonsHaveSeedsAndNumbers(Model model, Model without, Clip walk) {
    Expect(model.PersonAxes.Count >= 6 && model.PersonAxes.Contains("arm swing"), "axes of persons");
    Expect(without.PersonAxes.Count == 0, "a model without persons");
    var numbers = new float[model.PersonAxes.Count];
    numbers[0] = 2;
    ExpectMotions(model, walk, "persons",
                  new Action<Character>[] { one => {}, one => one.SetPerson(7),
                                            one => one.SetPerson(numbers),
                                            one => one.SetPerson(Model.PersonSeed("mara")) },
                  one => one.SetPerson(Model.PersonSeed("mara"), 1));
    using (var character = new Character(model, walk.Skeleton)) {
      ExpectRejection("a person's amount is 3", () => character.SetPerson(7, 3));
      ExpectRejection("1 numbers of a person; expected ", () => character.SetPerson(new float[1]));
    }
    using (var character = new Character(without, walk.Skeleton))
      ExpectRejection("the model has no persons; expected ", () => character.SetPerson(7));
  }

  static void EnergyCalmsTheInput(Model model, Clip walk) {
    ExpectMotions(model, walk, "energy",
                  new Action<Character>[] { one => one.SetShape(new Shape { Energy = 0.3f }),
                                            one => one.SetShape(new Shape()) });
  }

  static void ACharacterIsSavedShapedAndReports(Model model, Clip walk) {
    var options = new CharacterOptions { HoldFeet = 0, MaxLag = 1 };
    using (var character = new Character(model, walk.Skeleton, options)) {
      character.SetStrength("proud", 1);
      Play(character, walk, 0, 120);
      byte[] state = character.Save();
      byte[] first = Play(character, walk, 120, 150);
      Report report = character.Report();
      Expect(report.Gate > 0 && report.Gate <= 1, "a gate");
      Expect(report.LeftContact > 0 && report.LeftContact < 1, "a contact");
      Expect(report.Rate >= 0.5 && report.Rate <= 2 && report.Rate != 1, "a rate");
      Expect(report.Ahead < 0 && report.Ahead >= -1, "late, as the style is slower");
      character.Restore(state);
      Expect(Play(character, walk, 120, 150).SequenceEqual(first), "the same after restore");
      character.Restore(state);
      character.SetShape(new Shape { LeftArm = 0 });
      Expect(!Play(character, walk, 120, 150).SequenceEqual(first), "another with a shape");
      ExpectRejection("expected the ", () => character.Restore(new byte[9]));
    }
    ExpectRejection("max_lag", () => new Character(model, walk.Skeleton,
                                                   new CharacterOptions { MaxLag = 9 }));
  }

  static void ASkeletonIsFoundAmongJoints(Model model) {
    string[] names = { "Hips", "Spine", "Chest", "Neck", "Head", "LeftUpperArm", "LeftLowerArm",
                       "LeftHand", "RightUpperArm", "RightLowerArm", "RightHand", "LeftUpperLeg",
                       "LeftLowerLeg", "LeftFoot", "LeftToes", "RightUpperLeg", "RightLowerLeg",
                       "RightFoot", "RightToes" };
    int[] parents = { -1, 0, 1, 2, 3, 2, 5, 6, 2, 8, 9, 0, 11, 12, 13, 0, 15, 16, 17 };
    float[] positions = { 0, .95f, 0, 0, .15f, 0, 0, .15f, 0, 0, .22f, 0, 0, .1f, .02f,
                       .19f, .16f, 0, .02f, -.28f, 0, 0, -.25f, .02f,
                       -.19f, .16f, 0, -.02f, -.28f, 0, 0, -.25f, .02f,
                       .09f, -.04f, 0, 0, -.42f, 0, 0, -.41f, -.02f, 0, -.07f, .14f,
                       -.09f, -.04f, 0, 0, -.42f, 0, 0, -.41f, -.02f, 0, -.07f, .14f };
    var joints = names.Select((name, j) => new Joint {
      Name = name, Parent = parents[j], Translation = positions.Skip(3 * j).Take(3).ToArray()
    }).ToArray();
    using (var skeleton = new Skeleton(joints, "+Y", 1)) {
      Expect(skeleton.JointCount == 19 && skeleton.Find("leftHand") == 7, "the left hand");
      Expect(skeleton.Find("leftShoulder") == -1, "no clavicle");
      using (var character = new Character(model, skeleton)) {
        Array.Copy(positions, character.InputTranslations, positions.Length);
        character.Step(1.0 / 60);
        Expect(character.Rotations.SequenceEqual(character.InputRotations), "unchanged without style");
        Expect(character.Translations.SequenceEqual(positions), "unchanged without style");
      }
    }
    foreach (var joint in joints) joint.Name = "";  // By the map alone.
    var map = new Dictionary<string, int> { { "leftHand", -1 } };
    for (int j = 0; j < names.Length; ++j)
      map[char.ToLower(names[j][0]) + names[j].Substring(1)] = j;
    map["neck"] = -1;
    using (var skeleton = new Skeleton(joints, "+Y", 1, map)) {
      Expect(map.All(entry => skeleton.Find(entry.Key) == entry.Value), "the joints as given");
    }
    map["leftHand"] = 19;
    ExpectRejection("human joint 0 'leftHand': joint is 19; expected -1 to 18",
                    () => new Skeleton(joints, "+Y", 1, map));
    for (int j = 0; j < names.Length; ++j) joints[j].Name = names[j];
    joints[3].Parent = 9;
    ExpectRejection("joint 3 'Neck': parent is 9; expected a joint before it, or -1",
                    () => new Skeleton(joints));
    joints[3].Parent = 2;
    ExpectRejection("expected an up axis from +X to -Z, found 'up'",
                    () => new Skeleton(joints, "up"));
  }

  static void AStyleIsLearnt(Model model, Clip neutral, Clip styled) {
    Expect(model.Groups.Count == model.Styles.Count, "a group for each style");
    Learnt learnt = Learnt.Learn(model, "mine", neutral, styled);
    Expect(learnt.WasTested && learnt.HeldBackCm < learnt.UntouchedCm, "nearer with the style");
    Expect(learnt.Verdict == "good", "a verdict");
    using (var mine = new Model(learnt.ModelFile)) {
      Expect(mine.Groups.Last() == "", "a learnt style has no group");
      Expect(mine.Styles.SequenceEqual(model.Styles.Concat(new[] { "mine" })), "one style more");
      using (var character = new Character(mine, neutral.Skeleton)) {
        character.SetStrength("mine", 1);
        Play(character, neutral, 0, 30);
        Expect(!character.Rotations.SequenceEqual(character.InputRotations), "a change");
      }
      ExpectRejection("the model", () => Learnt.Learn(mine, "mine", neutral, styled));
      Expect(Learnt.Learn(mine, "mine", neutral, styled, true).ModelFile.Length > 0, "replaced");
    }
    var brief = new Clip { Skeleton = neutral.Skeleton, Rotations = neutral.Rotations,
                           Translations = new float[3] };
    ExpectRejection("clip: has ", () => Learnt.Learn(model, "brief", brief, styled));
  }

  static void AStyleIsLearntFromOneClip(Model model, byte[] bank, Clip neutral, Clip styled) {
    Learnt learnt = Learnt.LearnAlone(model, bank, "mine", styled);
    Expect(learnt.People >= 5 && learnt.Certainty > 0 && learnt.Certainty < 1, "how sure it is");
    Expect(Learnt.Learn(model, "mine", neutral, styled).People == 0, "nobody beside a pair");
    using (var mine = new Model(learnt.ModelFile)) {
      Expect(mine.Styles.SequenceEqual(model.Styles.Concat(new[] { "mine" })), "one style more");
      ExpectRejection("the model", () => Learnt.LearnAlone(mine, bank, "mine", styled));
      Expect(Learnt.LearnAlone(mine, bank, "mine", styled, true).People == learnt.People, "replaced");
    }
    ExpectRejection("the bank of neutral motion: ",
                    () => Learnt.LearnAlone(model, new byte[] { 1, 2, 3 }, "mine", styled));
  }

  static void ErrorsAreTheLibrarysSentences(Model model, string walk) {
    Expect(model.Styles.Contains("old"), "a style");
    ExpectRejection("model: has 3 bytes; expected a safetensors file", () => new Model(new byte[] { 1, 2, 3 }));
    ExpectRejection("unknown style 'odl'; the nearest is old", () => model.FindStyle("odl"));
    string broken = walk + ".broken.bvh";
    File.WriteAllText(broken, File.ReadAllText(walk).Substring(0, 300));
    ExpectRejection(broken + ":", () => Clip.Load(broken));
    ExpectRejection(walk + ": there is no motion 3; it has 1", () => Clip.Load(walk, 3));
  }

  static void FilesAreReadAtAGivenRateAndForTheirBody(string walk, string lit, string lamp) {
    string zero = walk + ".zero.bvh";
    File.WriteAllText(zero, Regex.Replace(File.ReadAllText(walk), "Frame Time:.*", "Frame Time: 0"));
    string found = Rejection(() => Clip.Load(zero));
    Expect(found.StartsWith(zero + ":") && found.EndsWith("give its rate"), found);
    Expect(Clip.Load(zero, framesPerSecond: 50).FrameSeconds == 1.0 / 50, "the rate that is given");
    Expect(Clip.Load(zero, framesPerSecond: 50).FrameCount == Clip.Load(walk).FrameCount, "all frames");
    foreach (double wrong in new[] { 0, -5, 20000, double.NaN, double.PositiveInfinity })
      ExpectRejection("expected a rate of 0.01 to 10000", () => Clip.Load(walk, null, wrong));
    float[] first = Clip.Load(lit).Rotations;
    Expect(first.SequenceEqual(Clip.Load(lit, 1).Rotations), "the body's motion, not the lamp's");
    Expect(!first.SequenceEqual(Clip.Load(lit, 0).Rotations), "the lamp's where it is asked for");
    ExpectRejection(lamp + ": none of its motions moves a joint of the humanoid",
                    () => Clip.Load(lamp));
  }

  static int Main(string[] arguments) {
    var model = Model.Load(arguments[0]);
    Clip walk = Clip.Load(arguments[1]), styled = Clip.Load(arguments[2]);
    StructsAreThoseOfTheHeader(File.ReadAllLines(arguments[7]));
    StepsHaveTheBitsOfC(model, walk, File.ReadAllBytes(arguments[3]));
    StylesHaveSides(model, walk);
    PersonsHaveSeedsAndNumbers(model, Model.Load(arguments[8]), walk);
    EnergyCalmsTheInput(model, walk);
    ACharacterIsSavedShapedAndReports(model, walk);
    ASkeletonIsFoundAmongJoints(model);
    AStyleIsLearnt(model, walk, styled);
    AStyleIsLearntFromOneClip(model, File.ReadAllBytes(arguments[6]), walk, styled);
    ErrorsAreTheLibrarysSentences(model, arguments[1]);
    FilesAreReadAtAGivenRateAndForTheirBody(arguments[1], arguments[4], arguments[5]);
    for (int i = 0; i < 200; ++i) new Character(model, walk.Skeleton);  // Given back by themselves.
    GC.Collect();
    GC.WaitForPendingFinalizers();
    Console.WriteLine("ok");
    return 0;
  }
}
