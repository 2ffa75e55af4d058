#pragma once

#include <optional>
#include <string>
#include <vector>

namespace onestroke {

/// What there is of OpenXR.
struct HeadsetSurvey {
  struct Extension {
    std::string name{};
    bool needed = false, offered = false;
    std::string lost{};  ///< What is not to be had without one that is not needed: "the world is our camera's alone".
  };
  struct Headset {
    std::string name{};
    int width = 0, height = 0;  ///< What each eye's image should measure; 0 where it shows no pair.
    std::vector<std::string> blend_modes{};
    bool orientation = false, position = false, hands = false;  ///< What it says that it follows.
  };

  std::string loader{};                 ///< The library's file, whose name ends with its version.
  std::string manifest{};               ///< The file that names the active runtime; empty where none is found.
  std::string runtime{};                ///< Its name and version; empty where none answers.
  std::string failure{};                ///< Why there is no headset, with the remedy; empty where there is one.
  std::vector<Extension> extensions{};  ///< All that the program can use; none where there is no runtime.
  std::optional<Headset> headset{};
};

/// Begins no session. Throws nothing of OpenXR's. Not beside an OpenXrDisplay: a loader allows one instance a program.
HeadsetSurvey survey_headset();

}  // namespace onestroke
