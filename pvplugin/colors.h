#pragma once

/// Colours in ParaView's JSON.
namespace lamella::colors
{

constexpr const char* phases_name = "Lamella Phases";
/// Of psi: Ld (below 0) red, Lo (above 0) blue.
constexpr const char* phases = R"({
  "Name": "Lamella Phases",
  "ColorSpace": "RGB",
  "RGBPoints": [-1, 0.886, 0.361, 0.314, 1, 0.376, 0.596, 0.839]
})";

constexpr const char* curvature_name = "Lamella Curvature";
/// Diverging: purple below the middle, white there, orange above.
constexpr const char* curvature = R"({
  "Name": "Lamella Curvature",
  "ColorSpace": "Lab",
  "NanColor": [0.6, 0.6, 0.6],
  "RGBPoints": [
    -1, 0.20, 0.06, 0.38,
    -0.5, 0.53, 0.45, 0.68,
    0, 0.97, 0.97, 0.97,
    0.5, 0.94, 0.65, 0.29,
    1, 0.52, 0.24, 0.03]
})";

/// What arrays of these names are coloured with when they are coloured for the first time: two colours
/// that meet at psi = 0 whatever its range.
constexpr const char* settings = R"({
  "array_lookup_tables": {
    "psi": {
      "PVLookupTable": {
        "AutomaticRescaleRangeMode": -1,
        "ColorSpace": 0,
        "Discretize": 1,
        "NumberOfTableValues": 2,
        "RGBPoints": [-1, 0.886, 0.361, 0.314, 1, 0.376, 0.596, 0.839],
        "Annotations": ["-0.5", "Ld", "0.5", "Lo"]
      }
    }
  },
  "standard_presets": {
    "K_M": "Lamella Curvature",
    "K": "Lamella Curvature"
  }
})";

}
