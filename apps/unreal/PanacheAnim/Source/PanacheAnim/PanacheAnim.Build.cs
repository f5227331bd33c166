using System.IO;
using UnrealBuildTool;

public class PanacheAnim : ModuleRules {
  public PanacheAnim(ReadOnlyTargetRules Target) : base(Target) {
    PublicDependencyModuleNames.AddRange(new[] { "Core", "CoreUObject", "Engine", "AnimGraphRuntime" });
    string ThirdParty = Path.Combine(PluginDirectory, "Source", "ThirdParty");
    PrivateIncludePaths.Add(Path.Combine(ThirdParty, "include"));
    if (Target.Platform == UnrealTargetPlatform.Win64) {
      // An import library made by `lib /def` of Visual Studio from the functions of panache.dll.
      PublicAdditionalLibraries.Add(Path.Combine(ThirdParty, "panache.lib"));
      PublicDelayLoadDLLs.Add("panache.dll");
      PrivateDefinitions.Add("PANACHE_USES_SHARED");
      RuntimeDependencies.Add("$(BinaryOutputDir)/panache.dll", Path.Combine(ThirdParty, "panache.dll"));
    } else {
      foreach (string Name in new[] { "libpanache.so", "libpanache_hwy.so" }) {  // Of scripts/unity.
        PublicAdditionalLibraries.Add(Path.Combine(ThirdParty, Name));
        RuntimeDependencies.Add("$(BinaryOutputDir)/" + Name, Path.Combine(ThirdParty, Name));
      }
    }
  }
}
