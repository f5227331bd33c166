#pragma once
#include "Animation/AnimNodeBase.h"
#include "AnimNode_Panache.generated.h"

struct FPanacheState;  // The library's objects and arrays.

USTRUCT(BlueprintInternalUseOnly)
struct PANACHEANIM_API FAnimNode_Panache : public FAnimNode_Base {
  GENERATED_BODY()

  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Links)
  FPoseLink Source;
  // 0 not at all, 1 as captured, by the names of the model's styles.
  UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = Settings, meta = (PinShownByDefault))
  TMap<FName, float> Styles;
  UPROPERTY(EditAnywhere, Category = Settings)
  FString ModelFile = TEXT("Panache/panache-int8.safetensors");  // In the project's Content.

  virtual void Initialize_AnyThread(const FAnimationInitializeContext& Context) override;
  virtual void CacheBones_AnyThread(const FAnimationCacheBonesContext& Context) override;
  virtual void Update_AnyThread(const FAnimationUpdateContext& Context) override;
  virtual void Evaluate_AnyThread(FPoseContext& Output) override;

 private:
  TSharedPtr<FPanacheState> State;
  double Seconds = 0;  // Since the last evaluation.
};
