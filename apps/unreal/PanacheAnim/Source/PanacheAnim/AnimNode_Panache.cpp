#include "AnimNode_Panache.h"
#include "Animation/AnimInstanceProxy.h"
#include "Misc/FileHelper.h"
#include "Misc/Paths.h"

#include <panache/panache.h>

struct FPanacheState {
  panache_model* Model = nullptr;
  panache_skeleton* Skeleton = nullptr;
  panache_character* Character = nullptr;
  TArray<float> Rotations, Translations;  // A joint for the component, then the bones of the pose.
  ~FPanacheState() {
    panache_character_destroy(Character);
    panache_skeleton_destroy(Skeleton);
    panache_model_destroy(Model);
  }
  void Put(int32 Joint, const FQuat& Q, const FVector& P) {
    const float R[] = {float(-Q.X), float(Q.Y), float(-Q.Z), float(Q.W)};
    const float T[] = {float(P.X), float(-P.Y), float(P.Z)};
    FMemory::Memcpy(&Rotations[4 * Joint], R, sizeof R);
    FMemory::Memcpy(&Translations[3 * Joint], T, sizeof T);
  }
};

void FAnimNode_Panache::Initialize_AnyThread(const FAnimationInitializeContext& Context) {
  FAnimNode_Base::Initialize_AnyThread(Context);
  Source.Initialize(Context);
}

// The bones of a level of detail changed: a skeleton of those that there are now.
void FAnimNode_Panache::CacheBones_AnyThread(const FAnimationCacheBonesContext& Context) {
  Source.CacheBones(Context);
  State.Reset();
  const FBoneContainer& Bones = Context.AnimInstanceProxy->GetRequiredBones();
  TSharedPtr<FPanacheState> Made = MakeShared<FPanacheState>();
  TArray<uint8> File;
  if (!FFileHelper::LoadFileToArray(File, *(FPaths::ProjectContentDir() / ModelFile))) return;
  TArray<TArray<ANSICHAR>> Names;
  TArray<panache_joint> Joints;
  const int32 Count = Bones.GetCompactPoseNumBones();
  Made->Rotations.SetNumZeroed(4 * (Count + 1));
  Made->Translations.SetNumZeroed(3 * (Count + 1));
  Made->Put(0, FQuat::Identity, FVector::ZeroVector);
  for (FCompactPoseBoneIndex Bone(0); Bone < Count; ++Bone) {
    const FTransform& Rest = Bones.GetRefPoseTransform(Bone);
    Made->Put(Bone.GetInt() + 1, Rest.GetRotation(), Rest.GetTranslation());
  }
  for (int32 Joint = 0; Joint <= Count; ++Joint) {
    FString Name;
    int32 Parent = -1;
    if (Joint > 0) {
      const FCompactPoseBoneIndex Bone(Joint - 1);
      Name = Bones.GetReferenceSkeleton()
                 .GetBoneName(Bones.MakeMeshPoseIndex(Bone).GetInt())
                 .ToString();
      Parent = Bones.GetParentBoneIndex(Bone).GetInt() + 1;  // -1 becomes the component.
    }
    const auto Utf8 = StringCast<ANSICHAR>(*Name);
    Names.Add(TArray<ANSICHAR>(Utf8.Get(), Utf8.Length() + 1));
    panache_joint Out = {Names.Last().GetData(), Parent};
    FMemory::Memcpy(Out.rotation, &Made->Rotations[4 * Joint], sizeof Out.rotation);
    FMemory::Memcpy(Out.translation, &Made->Translations[3 * Joint], sizeof Out.translation);
    Joints.Add(Out);
  }
  panache_skeleton_options Options = PANACHE_SKELETON_OPTIONS;
  Options.up_axis = "+Z";
  panache_character_options How = PANACHE_CHARACTER_OPTIONS;
  How.style_root = 0;  // The body stays with its actor.
  if (panache_model_create(File.GetData(), File.Num(), &Made->Model) != PANACHE_OK ||
      panache_skeleton_create(Joints.GetData(), Joints.Num(), &Options, &Made->Skeleton) !=
          PANACHE_OK ||
      panache_character_create(Made->Model, Made->Skeleton, &How, &Made->Character) != PANACHE_OK) {
    UE_LOG(LogAnimation, Error, TEXT("Panache: %s"), UTF8_TO_TCHAR(panache_last_error()));
    return;
  }
  State = Made;
}

void FAnimNode_Panache::Update_AnyThread(const FAnimationUpdateContext& Context) {
  Source.Update(Context);
  GetEvaluateGraphExposedInputs().Execute(Context);
  Seconds += Context.GetDeltaTime();
}

void FAnimNode_Panache::Evaluate_AnyThread(FPoseContext& Output) {
  Source.Evaluate(Output);
  if (!State || State->Rotations.Num() != 4 * (Output.Pose.GetNumBones() + 1)) return;
  for (const TPair<FName, float>& Style : Styles) {
    const auto Name = StringCast<ANSICHAR>(*Style.Key.ToString());
    panache_character_set_strength(State->Character,
                                   panache_model_find_style(State->Model, Name.Get()), Style.Value);
  }
  const FTransform& World = Output.AnimInstanceProxy->GetComponentTransform();
  const FVector At = World.GetTranslation() / World.GetScale3D().Z;
  State->Put(0, World.GetRotation(), FVector(At.X, At.Y, 0));  // The floor is where it stands.
  for (FCompactPoseBoneIndex Bone : Output.Pose.ForEachBoneIndex())
    State->Put(Bone.GetInt() + 1, Output.Pose[Bone].GetRotation(),
               Output.Pose[Bone].GetTranslation());
  float* R = State->Rotations.GetData();
  float* T = State->Translations.GetData();
  panache_character_step(State->Character, {R, T}, Seconds, {R, T});
  Seconds = 0;
  for (FCompactPoseBoneIndex Bone : Output.Pose.ForEachBoneIndex()) {
    const float *Q = R + 4 * (Bone.GetInt() + 1), *P = T + 3 * (Bone.GetInt() + 1);
    Output.Pose[Bone].SetRotation(FQuat(-Q[0], Q[1], -Q[2], Q[3]));
    Output.Pose[Bone].SetTranslation(FVector(P[0], -P[1], P[2]));
  }
}
