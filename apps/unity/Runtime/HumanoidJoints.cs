using System.Collections.Generic;
using UnityEngine;

namespace Panache.Unity {

/// Maps the transforms of a humanoid character to a library skeleton: first the Animator's, which
/// carries the root motion, then its bones and the transforms between them, parents first.
///
/// Unity is left-handed, the library right-handed. Both have Y up and bodies that face +z, so they
/// are mirror images in the plane x = 0. Converting only flips signs, so values that the library
/// does not change keep their bits.
internal sealed class HumanoidJoints {
  // The bones that styles rotate, except spine and chest: avatars have one to three bones there.
  private static readonly HumanBodyBones[] Bones = {
    HumanBodyBones.Hips, HumanBodyBones.Neck, HumanBodyBones.Head,
    HumanBodyBones.LeftShoulder, HumanBodyBones.LeftUpperArm, HumanBodyBones.LeftLowerArm,
    HumanBodyBones.LeftHand,
    HumanBodyBones.RightShoulder, HumanBodyBones.RightUpperArm, HumanBodyBones.RightLowerArm,
    HumanBodyBones.RightHand,
    HumanBodyBones.LeftUpperLeg, HumanBodyBones.LeftLowerLeg, HumanBodyBones.LeftFoot,
    HumanBodyBones.LeftToes,
    HumanBodyBones.RightUpperLeg, HumanBodyBones.RightLowerLeg, HumanBodyBones.RightFoot,
    HumanBodyBones.RightToes,
  };

  private readonly List<Transform> transforms = new List<Transform>();
  // World scale of each transform's parent: translations are in world metres.
  private readonly List<Vector3> scales = new List<Vector3>();
  private readonly int hips;
  // The last rotations that Load() read and Store() wrote. [joints]
  private readonly Quaternion[] read, written;
  private Vector3 readHips, writtenHips;
  private bool stored;

  /// Its rest pose is the character's pose at construction, with the feet on the floor.
  public Skeleton Skeleton { get; }

  /// Throws a PanacheException if the avatar is not a humanoid that the library can style.
  public HumanoidJoints(Animator animator) {
    if (!animator.isHuman)
      throw new PanacheException("'" + animator.name + "': its Animator has no humanoid avatar; " +
                                 "set Rig > Animation Type of the model to Humanoid");
    var wanted = new HashSet<Transform>();
    for (int bone = 0; bone < (int)HumanBodyBones.LastBone; ++bone) {
      Transform t = animator.GetBoneTransform((HumanBodyBones)bone);
      for (; t != null && t != animator.transform && wanted.Add(t); t = t.parent) {}
    }
    var joints = new List<Joint>();
    Add(animator.transform, -1, wanted, joints);
    var human = new Dictionary<string, int>();
    foreach (HumanBodyBones bone in Bones) {  // VRM calls LeftHand "leftHand".
      string name = bone.ToString();
      human[char.ToLowerInvariant(name[0]) + name.Substring(1)] = IndexOf(animator, bone);
    }
    int upperChest = IndexOf(animator, HumanBodyBones.UpperChest);
    int chest = IndexOf(animator, HumanBodyBones.Chest);
    int spine = IndexOf(animator, HumanBodyBones.Spine);
    // Map the highest bone to the chest and the next one below to the spine.
    human["chest"] = upperChest >= 0 ? upperChest : chest >= 0 ? chest : spine;
    human["spine"] = upperChest >= 0 && chest >= 0 ? chest
                     : upperChest >= 0 || chest >= 0 ? spine : -1;
    hips = human["hips"];
    Skeleton = new Skeleton(joints, "+Y", 0, human);
    read = new Quaternion[joints.Count];
    written = new Quaternion[joints.Count];
  }

  /// Reads the current pose into a character's input. A joint that still is as Store() left it was
  /// not animated since (culled Animator, frame between physics steps): its last input is reused.
  public void Load(Character character) {
    float[] r = character.InputRotations, p = character.InputTranslations;
    for (int j = 0; j < transforms.Count; ++j) {
      Quaternion q = j == 0 ? transforms[j].rotation : transforms[j].localRotation;
      if (!stored || j == 0 || !q.Equals(written[j])) read[j] = q;
      ToLibrary(read[j], r, j);
      Vector3 at = transforms[j].localPosition;
      if (j == hips) {
        if (!stored || !at.Equals(writtenHips)) readHips = at;
        at = readHips;
      }
      ToLibrary(Vector3.Scale(at, scales[j]), p, j);
    }
    // The floor is at the height of the GameObject.
    Vector3 root = transforms[0].position;
    ToLibrary(new Vector3(root.x, 0, root.z), p, 0);
  }

  /// Writes a character's output to the transforms, except values that the style did not change.
  public void Store(Character character) {
    float[] from = character.InputRotations, r = character.Rotations;
    for (int j = 1; j < transforms.Count; ++j) {
      Quaternion q = read[j];
      if (r[4 * j] != from[4 * j] || r[4 * j + 1] != from[4 * j + 1] ||
          r[4 * j + 2] != from[4 * j + 2] || r[4 * j + 3] != from[4 * j + 3])
        q = new Quaternion(r[4 * j], -r[4 * j + 1], -r[4 * j + 2], r[4 * j + 3]);
      if (!q.Equals(transforms[j].localRotation)) transforms[j].localRotation = q;
      written[j] = transforms[j].localRotation;
    }
    StoreHips(character.InputTranslations, character.Translations);
    stored = true;
  }
  private void StoreHips(float[] from, float[] p) {
    int x = 3 * hips, y = x + 1, z = x + 2;
    Vector3 at = readHips, scale = scales[hips];
    if (p[x] != from[x] || p[y] != from[y] || p[z] != from[z])
      at = new Vector3(-p[x] / scale.x, p[y] / scale.y, p[z] / scale.z);
    if (!at.Equals(transforms[hips].localPosition)) transforms[hips].localPosition = at;
    writtenHips = transforms[hips].localPosition;
  }

  private int IndexOf(Animator animator, HumanBodyBones bone) {
    Transform t = animator.GetBoneTransform(bone);
    return t == null ? -1 : transforms.IndexOf(t);
  }
  private void Add(Transform t, int parent, HashSet<Transform> wanted, List<Joint> joints) {
    int index = joints.Count;
    var joint = new Joint { Name = t.name, Parent = parent };
    transforms.Add(t);
    scales.Add(parent < 0 ? Vector3.one : t.parent.lossyScale);
    if (parent >= 0) {  // The rest pose is at the origin and faces +z.
      ToLibrary(t.localRotation, joint.Rotation, 0);
      ToLibrary(Vector3.Scale(t.localPosition, scales[index]), joint.Translation, 0);
    }
    joints.Add(joint);
    for (int child = 0; child < t.childCount; ++child)
      if (wanted.Contains(t.GetChild(child))) Add(t.GetChild(child), index, wanted, joints);
  }

  private static void ToLibrary(Quaternion q, float[] out4, int joint) {
    out4[4 * joint] = q.x;
    out4[4 * joint + 1] = -q.y;
    out4[4 * joint + 2] = -q.z;
    out4[4 * joint + 3] = q.w;
  }
  private static void ToLibrary(Vector3 v, float[] out3, int joint) {
    out3[3 * joint] = -v.x;
    out3[3 * joint + 1] = v.y;
    out3[3 * joint + 2] = v.z;
  }
}

}  // namespace Panache.Unity
