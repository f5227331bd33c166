// What the Unity package uses of UnityEngine, for tests without Unity: the same names and meanings,
// as far as they are needed. Quaternions and vectors are plain numbers; Transforms are a hierarchy
// with local positions, rotations and scales, from which the world's are computed.

using System;
using System.Collections.Generic;

namespace UnityEngine {

public struct Vector3 {
  public float x, y, z;
  public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
  public static Vector3 zero => new Vector3(0, 0, 0);
  public static Vector3 one => new Vector3(1, 1, 1);
  public static Vector3 operator +(Vector3 a, Vector3 b) =>
      new Vector3(a.x + b.x, a.y + b.y, a.z + b.z);
  public static Vector3 operator -(Vector3 a, Vector3 b) =>
      new Vector3(a.x - b.x, a.y - b.y, a.z - b.z);
  public static Vector3 Scale(Vector3 a, Vector3 b) => new Vector3(a.x * b.x, a.y * b.y, a.z * b.z);
  public float magnitude => (float)Math.Sqrt(x * x + y * y + z * z);
  public bool Equals(Vector3 o) => x == o.x && y == o.y && z == o.z;
}

public struct Quaternion {
  public float x, y, z, w;
  public Quaternion(float x, float y, float z, float w) {
    this.x = x; this.y = y; this.z = z; this.w = w;
  }
  public static Quaternion identity => new Quaternion(0, 0, 0, 1);
  public static Quaternion operator *(Quaternion a, Quaternion b) => new Quaternion(
      a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
  public static Vector3 operator *(Quaternion q, Vector3 v) {
    Quaternion r = q * new Quaternion(v.x, v.y, v.z, 0) * new Quaternion(-q.x, -q.y, -q.z, q.w);
    return new Vector3(r.x, r.y, r.z);
  }
  public bool Equals(Quaternion o) => x == o.x && y == o.y && z == o.z && w == o.w;
}

public class Object {
  public string name = "";
}

public class Component : Object {
  public GameObject gameObject;
  public Transform transform => gameObject.transform;
  public T GetComponent<T>() where T : Component => gameObject.GetComponent<T>();
}

public class GameObject : Object {
  public readonly Transform transform;
  private readonly List<Component> components = new List<Component>();
  public GameObject(string name) {
    this.name = name;
    transform = AddComponent<Transform>();
  }
  public T AddComponent<T>() where T : Component, new() {
    var added = new T { gameObject = this, name = name };
    components.Add(added);
    return added;
  }
  public T GetComponent<T>() where T : Component => (T)components.Find(c => c is T);
}

public class Transform : Component {
  private readonly List<Transform> children = new List<Transform>();
  private Transform above;
  public Vector3 localPosition, localScale = Vector3.one;
  public Quaternion localRotation = Quaternion.identity;
  public Transform parent {
    get => above;
    set {
      above = value;
      value.children.Add(this);
    }
  }
  public int childCount => children.Count;
  public Transform GetChild(int index) => children[index];
  public Quaternion rotation => above == null ? localRotation : above.rotation * localRotation;
  public Vector3 lossyScale =>
      above == null ? localScale : Vector3.Scale(above.lossyScale, localScale);
  public Vector3 position => above == null ? localPosition
      : above.position + above.rotation * Vector3.Scale(localPosition, above.lossyScale);
}

public class MonoBehaviour : Component {
  public bool enabled = true;
}

public class TextAsset : Object {
  public byte[] bytes;
}

public class Animator : Component {
  public bool isHuman = true;
  public readonly Dictionary<HumanBodyBones, Transform> Bones =
      new Dictionary<HumanBodyBones, Transform>();
  public Transform GetBoneTransform(HumanBodyBones bone) {
    if (bone < 0 || bone >= HumanBodyBones.LastBone) throw new IndexOutOfRangeException();
    return Bones.TryGetValue(bone, out Transform found) ? found : null;
  }
}

public enum HumanBodyBones {
  Hips, LeftUpperLeg, RightUpperLeg, LeftLowerLeg, RightLowerLeg, LeftFoot, RightFoot, Spine, Chest,
  Neck, Head, LeftShoulder, RightShoulder, LeftUpperArm, RightUpperArm, LeftLowerArm, RightLowerArm,
  LeftHand, RightHand, LeftToes, RightToes, LeftEye, RightEye, Jaw, LeftThumbProximal,
  LeftThumbIntermediate, LeftThumbDistal, LeftIndexProximal, LeftIndexIntermediate, LeftIndexDistal,
  LeftMiddleProximal, LeftMiddleIntermediate, LeftMiddleDistal, LeftRingProximal,
  LeftRingIntermediate, LeftRingDistal, LeftLittleProximal, LeftLittleIntermediate,
  LeftLittleDistal, RightThumbProximal, RightThumbIntermediate, RightThumbDistal,
  RightIndexProximal, RightIndexIntermediate, RightIndexDistal, RightMiddleProximal,
  RightMiddleIntermediate, RightMiddleDistal, RightRingProximal, RightRingIntermediate,
  RightRingDistal, RightLittleProximal, RightLittleIntermediate, RightLittleDistal, UpperChest,
  LastBone
}

public static class Time {
  public static float deltaTime = 1f / 30;
}

public static class Mathf {
  public static float Clamp(float value, float min, float max) =>
      value < min ? min : value > max ? max : value;
}

public static class Debug {
  public static readonly List<string> Errors = new List<string>();
  public static void LogError(object message, Object about) { Errors.Add(message.ToString()); }
}

public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string text) {} }
public sealed class RangeAttribute : Attribute { public RangeAttribute(float from, float to) {} }
public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string menu) {} }
public sealed class ContextMenu : Attribute { public ContextMenu(string item) {} }
public sealed class RequireComponent : Attribute { public RequireComponent(Type type) {} }
public sealed class DisallowMultipleComponent : Attribute {}
public sealed class DefaultExecutionOrder : Attribute { public DefaultExecutionOrder(int order) {} }

}  // namespace UnityEngine
