using System;
using System.Collections.Generic;
using UnityEngine;

namespace Panache.Unity {

/// The strength and the side of one style.
[Serializable]
public sealed class StyleStrength {
  [Tooltip("A style of the model, such as old.")]
  public string style = "";
  [Range(-1, 2), Tooltip("0 not at all, 1 as captured, more exaggerates, less than 0 does the opposite.")]
  public float strength;
  [Range(-1, 1), Tooltip("1 as captured, -1 mirrored: a limp changes legs. The model's Sides tell " +
                         "which side was captured.")]
  public float side = 1;
}

/// Scales the parts of what the styles do; 1 is the style as the model has it.
[Serializable]
public sealed class StyleShape {
  [Range(0, 2), Tooltip("Of the lasting part of the change.")] public float posture = 1;
  [Range(0, 2), Tooltip("Of the change's movement.")] public float dynamics = 1;
  [Range(0, 2)] public float legs = 1;
  [Range(0, 2)] public float torso = 1;
  [Range(0, 2)] public float leftArm = 1;
  [Range(0, 2)] public float rightArm = 1;
  [Range(0, 1), Tooltip("How firmly planted feet are held.")] public float footLock = 1;
  [Range(0, 1), Tooltip("How firmly hands keep what they touch.")] public float handContacts = 1;
  [Range(0, 2), Tooltip("From calm (0) to lively (2): the animation's own movement of torso, head " +
                        "and arms, without a style, too.")]
  public float energy = 1;

  /// Copies the amounts. Returns whether any of them changed.
  internal bool CopyTo(Shape shape) {
    if (shape.Posture == posture && shape.Dynamics == dynamics && shape.Legs == legs &&
        shape.Torso == torso && shape.LeftArm == leftArm && shape.RightArm == rightArm &&
        shape.FootLock == footLock && shape.HandContacts == handContacts &&
        shape.Energy == energy)
      return false;
    shape.Posture = posture;
    shape.Dynamics = dynamics;
    shape.Legs = legs;
    shape.Torso = torso;
    shape.LeftArm = leftArm;
    shape.RightArm = rightArm;
    shape.FootLock = footLock;
    shape.HandContacts = handContacts;
    shape.Energy = energy;
    return true;
  }
}

/// Styles the pose of a humanoid Animator in each frame, after the animation and before the
/// LateUpdate of other scripts. The pose at Awake is the rest pose: upright, with the feet on the
/// floor at the height of the GameObject.
[AddComponentMenu("Animation/Panache Character")]
[RequireComponent(typeof(Animator))]
[DisallowMultipleComponent]
[DefaultExecutionOrder(-100)]
public sealed class PanacheCharacter : MonoBehaviour {
  [Tooltip("A model file (.safetensors) whose name ends in .bytes, such as Models/panache-int8.")]
  public TextAsset model;
  [Tooltip("The styles, which add up.")]
  public List<StyleStrength> styles = new List<StyleStrength>();
  [Tooltip("Who the character moves as, in addition to its styles: a number or a word, each is " +
           "another person. Empty: nobody.")]
  public string person = "";
  [Range(0, 2), Tooltip("How far the person is from the mean of people: 1 as real people differ, " +
                        "0 not at all.")]
  public float variety = 1;
  public StyleShape shape = new StyleShape();
  [Tooltip("Planted feet stay where they are. Read when the component is enabled.")]
  public bool holdFeet = true;
  [Tooltip("The body moves at the style's own pace and so leaves its GameObject. " +
           "Read when the component is enabled.")]
  public bool styleRoot;
  [Range(0, 2), Tooltip("How often the styles make their gestures: 1 as often as the performers, " +
                        "0 never. Read when the component is enabled.")]
  public float gestures = 1;
  [Tooltip("Characters with different seeds make gestures at different times. " +
           "Read when the component is enabled.")]
  public uint gestureSeed;

  // All characters that use the same file share its model.
  private static readonly Dictionary<TextAsset, Model> Models = new Dictionary<TextAsset, Model>();

  private HumanoidJoints joints;
  private Character character;
  private Model read;
  private float[] wanted, set;            // Strength of each style of the model,
  private float[] wantedSides, setSides;  // and its side.
  private readonly Dictionary<string, int> styleIndices =
      new Dictionary<string, int>(StringComparer.OrdinalIgnoreCase);
  private readonly HashSet<string> unknown = new HashSet<string>();
  private Shape shaped;
  private string setPerson;
  private float setVariety;
  private bool toldNoPersons;  // The error that the model has none.

  /// Sets the strength of a style; adds it to the list if it is not there.
  public void SetStrength(string style, float strength) { EntryOf(style).strength = strength; }

  /// Sets the side of a style, 1 as captured to -1 mirrored; adds it to the list, with a strength of
  /// 0, if it is not there.
  public void SetSide(string style, float side) { EntryOf(style).side = side; }

  private StyleStrength EntryOf(string style) {
    StyleStrength entry = styles.Find(
        other => string.Equals(other.style, style, StringComparison.OrdinalIgnoreCase));
    if (entry == null) styles.Add(entry = new StyleStrength { style = style });
    return entry;
  }

  /// Forgets the motion so far; call it after a teleport. Hips faster than 15 m/s also cause this.
  public void ResetMotion() { character?.Reset(); }

  /// Adds the model's missing styles to the list, with a strength of 0.
  [ContextMenu("List the model's styles")]
  public void ListStyles() {
    if (model == null) return;
    foreach (string style in Read(model).Styles)
      if (!styles.Exists(entry => string.Equals(entry.style, style,
                                                StringComparison.OrdinalIgnoreCase)))
        styles.Add(new StyleStrength { style = style });
  }

  private static Model Read(TextAsset file) {
    if (!Models.TryGetValue(file, out Model found)) Models[file] = found = new Model(file.bytes);
    return found;
  }

  private void Awake() {
    Try(() => joints = new HumanoidJoints(GetComponent<Animator>()));
  }
  private void OnEnable() {
    if (joints == null) return;
    Try(() => {
      if (model == null) throw new PanacheException("'" + name + "': expected a model, found none");
      read = Read(model);
      character = new Character(read, joints.Skeleton, new CharacterOptions {
        HoldFeet = holdFeet ? 1 : 0, StyleRoot = styleRoot ? 1 : 0, GestureRate = gestures,
        GestureSeed = gestureSeed
      });
      shaped = new Shape();
      setPerson = "";
      setVariety = 1;
      toldNoPersons = false;
      wanted = new float[read.Styles.Count];
      set = new float[read.Styles.Count];
      wantedSides = new float[read.Styles.Count];
      setSides = new float[read.Styles.Count];
      for (int i = 0; i < setSides.Length; ++i) setSides[i] = 1;
      styleIndices.Clear();
      for (int i = 0; i < read.Styles.Count; ++i) styleIndices[read.Styles[i]] = i;
      unknown.Clear();
    });
  }
  private void OnDisable() {
    character?.Dispose();
    character = null;
  }
  private void OnDestroy() { joints?.Skeleton.Dispose(); }

  private void LateUpdate() {
    if (character == null) return;
    SetStyles();
    SetPerson();
    joints.Load(character);
    character.Step(Time.deltaTime);
    joints.Store(character);
  }

  private void SetStyles() {
    if (shape.CopyTo(shaped)) character.SetShape(shaped);
    Array.Clear(wanted, 0, wanted.Length);
    for (int i = 0; i < wantedSides.Length; ++i) wantedSides[i] = 1;
    foreach (StyleStrength entry in styles) {
      if (string.IsNullOrEmpty(entry.style)) continue;
      if (styleIndices.TryGetValue(entry.style, out int index)) {
        wanted[index] += entry.strength;
        wantedSides[index] = entry.side;
      } else if (unknown.Add(entry.style)) {
        TellUnknown(entry.style);
      }
    }
    for (int i = 0; i < wanted.Length; ++i) {
      if (wantedSides[i] != setSides[i]) {
        setSides[i] = wantedSides[i];
        character.SetSide(read.Styles[i], setSides[i]);
      }
      if (wanted[i] == set[i]) continue;
      set[i] = wanted[i];
      character.SetStrength(read.Styles[i], set[i]);
    }
  }

  private void SetPerson() {
    if (person == setPerson && variety.Equals(setVariety)) return;
    setPerson = person;
    setVariety = variety;
    if (read.PersonAxes.Count == 0) {
      if (toldNoPersons || string.IsNullOrWhiteSpace(person)) return;
      toldNoPersons = true;
    }
    Try(PutOnPerson, false);
  }

  private void PutOnPerson() {
    if (string.IsNullOrWhiteSpace(person)) character.SetPerson(0, 0);
    else character.SetPerson(Model.PersonSeed(person.Trim()), Mathf.Clamp(variety, 0, 2));
  }

  private void TellUnknown(string style) { Try(() => read.FindStyle(style), false); }

  // Logs failures; disables the component if it lacks a skeleton, model or library (`needed`).
  private void Try(Action action, bool needed = true) {
    try {
      action();
    } catch (Exception error) when (error is PanacheException || error is DllNotFoundException ||
                                    error is TypeInitializationException) {
      Debug.LogError("Panache: " + (error.InnerException ?? error).Message, this);
      if (needed) enabled = false;
    }
  }
}

}  // namespace Panache.Unity
