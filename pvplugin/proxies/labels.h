#pragma once
#include <string_view>
#include <vector>

namespace lamella {

/// How the panel shows the parameters of scenes: the groups in their order, and in each the
/// parameters in theirs.
struct Label {
  std::string_view key, text;
  bool advanced = false;
};
struct Group {
  std::string_view title;
  std::vector<Label> labels;
};

/// Python names properties after the ASCII letters and digits of their labels: symbols and units
/// are therefore of other letters. Units: energy ε, length ℓ, time τ, grid spacing ℎ.
inline const std::vector<Group>& panel_groups() {
  constexpr bool advanced = true;
  static const std::vector<Group> groups{
      {"Shape",
       {
           {"shape.kind", "Shape"},
           {"shape.radius", "Radius (ℓ)"},
           {"shape.semi_axis", "Semi Axis (ℓ)"},
           {"shape.reduced_volume", "Reduced Volume"},
           {"shape.semi_axes", "Semi Axes (ℓ)"},
           {"shape.ring_radius", "Ring Radius (ℓ)"},
           {"shape.tube_radius", "Tube Radius (ℓ)"},
           {"shape.file", "Stored Frame"},
           {"shape.center", "Center (ℓ)", advanced},
           {"shape.rotation_axis", "Rotation Axis", advanced},
           {"shape.rotation_angle", "Rotation Angle (°)", advanced},
           {"perturbation.amplitude", "Perturbation (ℓ)"},
           {"perturbation.wavelength", "Perturbation Wavelength (ℓ)", advanced},
           {"perturbation.seed", "Perturbation Seed", advanced},
           {"perturbation.fold", "Perturbation Fold", advanced},
       }},
      {"Membrane",
       {
           {"membrane.bending_modulus", "Bending Modulus κ (ε)"},
           {"membrane.spontaneous_curvature", "Spontaneous Curvature (ℓ⁻¹)"},
           {"membrane.gaussian_modulus", "Gaussian Modulus κ̄ (ε)", advanced},
           {"membrane.linear_modulus", "Linear Modulus (ε⁄ℓ)", advanced},
           {"membrane.cubic_modulus", "Cubic Modulus (εℓ)", advanced},
           {"membrane.mixed_cubic_modulus", "Mixed Cubic Modulus (εℓ)", advanced},
           {"membrane.quartic_modulus", "Quartic Modulus (εℓ²)", advanced},
           {"membrane.mixed_quartic_modulus", "Mixed Quartic Modulus (εℓ²)", advanced},
           {"membrane.gaussian_square_modulus", "Gaussian Square Modulus (εℓ²)", advanced},
           {"membrane.gradient_modulus", "Gradient Modulus (εℓ²)", advanced},
           {"membrane.density", "Density (ε⁄ℓ²)", advanced},
           {"parameters", "Parameters", advanced},
           {"fields", "Fields", advanced},
           {"stretch.modulus", "Stretch Modulus μ (ε⁄ℓ²)", advanced},
       }},
      {"Phases",
       {
           {"domains.kind", "Domains"},
           {"domains.area_fraction", "Area Fraction"},
           {"domains.direction", "Direction", advanced},
           {"domains.directions", "Directions"},
           {"domains.half_angle", "Half Angle (°)"},
           {"domains.bulge", "Bulge (°)", advanced},
           {"domains.file", "Stored Phases", advanced},
           {"domains.curvature_start_time", "Curvature Start Time (τ)", advanced},
           {"line.tension", "Line Tension κₗ (ε⁄ℓ)"},
           {"ld.bending_modulus", "Ld Bending Modulus κ (ε)"},
           {"ld.spontaneous_curvature", "Ld Spontaneous Curvature (ℓ⁻¹)"},
           {"ld.gaussian_modulus", "Ld Gaussian Modulus κ̄ (ε)", advanced},
           {"ld.linear_modulus", "Ld Linear Modulus (ε⁄ℓ)", advanced},
           {"ld.cubic_modulus", "Ld Cubic Modulus (εℓ)", advanced},
           {"ld.mixed_cubic_modulus", "Ld Mixed Cubic Modulus (εℓ)", advanced},
           {"ld.quartic_modulus", "Ld Quartic Modulus (εℓ²)", advanced},
           {"ld.mixed_quartic_modulus", "Ld Mixed Quartic Modulus (εℓ²)", advanced},
           {"ld.gaussian_square_modulus", "Ld Gaussian Square Modulus (εℓ²)", advanced},
           {"ld.gradient_modulus", "Ld Gradient Modulus (εℓ²)", advanced},
           {"ld.density", "Ld Density (ε⁄ℓ²)", advanced},
           {"lo.bending_modulus", "Lo Bending Modulus κ (ε)"},
           {"lo.spontaneous_curvature", "Lo Spontaneous Curvature (ℓ⁻¹)"},
           {"lo.gaussian_modulus", "Lo Gaussian Modulus κ̄ (ε)", advanced},
           {"lo.linear_modulus", "Lo Linear Modulus (ε⁄ℓ)", advanced},
           {"lo.cubic_modulus", "Lo Cubic Modulus (εℓ)", advanced},
           {"lo.mixed_cubic_modulus", "Lo Mixed Cubic Modulus (εℓ)", advanced},
           {"lo.quartic_modulus", "Lo Quartic Modulus (εℓ²)", advanced},
           {"lo.mixed_quartic_modulus", "Lo Mixed Quartic Modulus (εℓ²)", advanced},
           {"lo.gaussian_square_modulus", "Lo Gaussian Square Modulus (εℓ²)", advanced},
           {"lo.gradient_modulus", "Lo Gradient Modulus (εℓ²)", advanced},
           {"lo.density", "Lo Density (ε⁄ℓ²)", advanced},
           {"line.geodesic_modulus", "Line Geodesic Modulus (ε)", advanced},
           {"line.torsion_modulus", "Line Torsion Modulus (ε)", advanced},
           {"line.normal_modulus", "Line Normal Modulus (ε)", advanced},
           {"line.geodesic_square_modulus", "Line Geodesic Square Modulus (ε ℓ)", advanced},
           {"line.torsion_square_modulus", "Line Torsion Square Modulus (ε ℓ)", advanced},
           {"line.normal_square_modulus", "Line Normal Square Modulus (ε ℓ)", advanced},
           {"line.perpendicular_modulus", "Line Perpendicular Modulus (ε)", advanced},
           {"line.density", "Line Density (ε⁄ℓ)", advanced},
           {"line.drag", "Line Drag (ℓ)", advanced},
       }},
      {"Constraints",
       {
           {"volume.constraint", "Volume"},
           {"volume.targets", "Volume Targets"},
           {"volume.rate", "Volume Rate (τ⁻¹)"},
           {"volume.pressure", "Pressure (ε⁄ℓ³)"},
           {"volume.of", "Volume Of", advanced},
           {"area.of", "Area Of", advanced},
           {"area_difference.constraint", "Area Difference"},
           {"area_difference.targets", "Area Difference Targets"},
           {"area_difference.rate", "Area Difference Rate (τ⁻¹)"},
           {"area_difference.multiplier", "Area Difference Multiplier (ε⁄ℓ)", advanced},
           {"contact.topology_changes", "Topology Changes", advanced},
           {"contact.rupture_thickness", "Rupture Thickness (ℓ)", advanced},
           {"contact.disjoining_pressure", "Disjoining Pressure (ε⁄ℓ³)", advanced},
           {"contact.disjoining_range", "Disjoining Range (ℓ)", advanced},
       }},
      {"Numerics",
       {
           {"grid.nodes", "Nodes"},
           {"grid.half_width", "Half Width (ℓ)"},
           {"numerics.tolerance", "Tolerance (ℎ)", advanced},
           {"numerics.max_time_step", "Max Time Step (τ)", advanced},
       }},
      {"Output",
       {
           {"run.end_time", "End Time (τ)"},
           {"output.frames", "Frames"},
           {"stop.energy_rate", "Stop At Energy Rate (τ⁻¹)", advanced},
           {"stop.residual_force", "Stop At Residual Force (ℓ⁄τ)", advanced},
           {"stop.topology_changes", "Stop At Topology Changes", advanced},
           {"stop.wall_time", "Stop At Wall Time", advanced},
       }},
  };
  return groups;
}

} // namespace lamella
