#include "vtkVesicle.h"

#include "fields/scene_properties.h"
#include "scene/scene_toml.h"

#include <vtkObjectFactory.h>
#include <vtkVesicleSceneReader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

vtkStandardNewMacro(vtkVesicle);

namespace
{
using lamella::Member;

const lamella::Key* FindKey(std::string_view path)
{
  const auto dot = path.find('.');
  if (dot != path.npos)
  {
    return lamella::find_key(path.substr(0, dot), path.substr(dot + 1));
  }
  const lamella::Key* ofSection = lamella::find_key(path, ""); // that takes any name
  return ofSection ? ofSection : lamella::find_key("", path);
}

bool SetMember(lamella::Scene& scene, const lamella::Access& access, double value)
{
  if (const auto* real = std::get_if<Member<double>>(&access))
  {
    (*real)(scene) = value;
    return true;
  }
  if (const auto* integer = std::get_if<Member<int>>(&access))
  {
    (*integer)(scene) = static_cast<int>(std::lround(value));
    return true;
  }
  if (const auto* flag = std::get_if<Member<bool>>(&access))
  {
    (*flag)(scene) = value != 0;
    return true;
  }
  return false;
}

bool SetMember(lamella::Scene& scene, const lamella::Access& access, const lamella::Vec3& value)
{
  if (const auto* vector = std::get_if<Member<lamella::Vec3>>(&access))
  {
    (*vector)(scene) = value;
    return true;
  }
  if (const auto* counts = std::get_if<Member<std::array<int, 3>>>(&access))
  {
    std::transform(value.begin(), value.end(), (*counts)(scene).begin(),
      [](double x) { return static_cast<int>(std::lround(x)); });
    return true;
  }
  return false;
}

bool SetMember(lamella::PropertyScene& scene, const lamella::Key& key, const std::string& value)
{
  if (const auto* text = std::get_if<Member<std::string>>(&key.access))
  {
    (*text)(scene) = value;
    return true;
  }
  if (std::holds_alternative<Member<lamella::Parameters>>(key.access))
  {
    lamella::set_parameters(scene, value);
    return true;
  }
  if (std::holds_alternative<Member<lamella::MaterialFields>>(key.access))
  {
    lamella::set_fields(scene, value);
    return true;
  }
  if (std::holds_alternative<lamella::Choice>(key.access))
  {
    lamella::set_choice(scene, key, value);
    return true;
  }
  return false;
}
}

vtkVesicle::vtkVesicle()
  : Scene(std::make_unique<lamella::PropertyScene>())
{
}

vtkVesicle::~vtkVesicle() = default;

vtkAlgorithm* vtkVesicle::GetRun()
{
  return this->Reader;
}

void vtkVesicle::Prepare()
{
  lamella::check_choices(*this->Scene);
  lamella::validate(*this->Scene);
  const std::string text = lamella::to_toml(*this->Scene);
  if (text != this->Reader->GetSceneText())
  {
    this->Reader->SetSceneText(text.c_str());
  }
}

void vtkVesicle::SetNumber(const char* key, double value)
{
  const lamella::Key* found = FindKey(key);
  if (!found || !SetMember(*this->Scene, found->access, value))
  {
    vtkErrorMacro("no number is called " << key);
  }
  this->Modified();
}

void vtkVesicle::SetVector(const char* key, double x, double y, double z)
{
  const lamella::Key* found = FindKey(key);
  if (!found || !SetMember(*this->Scene, found->access, lamella::Vec3{ x, y, z }))
  {
    vtkErrorMacro("no vector is called " << key);
  }
  this->Modified();
}

void vtkVesicle::SetText(const char* key, const char* value)
{
  const lamella::Key* found = FindKey(key);
  if (!found || !SetMember(*this->Scene, *found, value ? value : ""))
  {
    vtkErrorMacro("no text is called " << key);
  }
  this->Modified();
}

void vtkVesicle::AddDomain(double x, double y, double z)
{
  this->Scene->domains.directions.push_back({ x, y, z });
  this->Modified();
}

void vtkVesicle::RemoveAllDomains()
{
  this->Scene->domains.directions.clear();
  this->Modified();
}

void vtkVesicle::AddVolumeTarget(double target, double start_time)
{
  lamella::add_target(this->Scene->volume.ramp, target, start_time);
  this->Modified();
}

void vtkVesicle::RemoveAllVolumeTargets()
{
  lamella::remove_targets(this->Scene->volume.ramp);
  this->Modified();
}

void vtkVesicle::AddAreaDifferenceTarget(double target, double start_time)
{
  lamella::add_target(this->Scene->area_difference.ramp, target, start_time);
  this->Modified();
}

void vtkVesicle::RemoveAllAreaDifferenceTargets()
{
  lamella::remove_targets(this->Scene->area_difference.ramp);
  this->Modified();
}
