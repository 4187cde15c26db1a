#include "vtkVesicle.h"

#include "scene/keys.h"
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
  return dot == path.npos ? nullptr : lamella::find_key(path.substr(0, dot), path.substr(dot + 1));
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

bool SetMember(lamella::Scene& scene, const lamella::Access& access, const std::string& value)
{
  if (const auto* text = std::get_if<Member<std::string>>(&access))
  {
    (*text)(scene) = value;
    return true;
  }
  if (const auto* choice = std::get_if<lamella::Choice>(&access))
  {
    const auto name = std::find(choice->names.begin(), choice->names.end(), value);
    if (name != choice->names.end())
    {
      choice->set(scene, static_cast<int>(name - choice->names.begin()));
      return true;
    }
  }
  return false;
}

void AddTarget(lamella::Ramp& ramp, double target, double start_time)
{
  ramp.targets.push_back(target);
  ramp.start_times.push_back(start_time);
}
}

vtkVesicle::vtkVesicle()
  : Scene(std::make_unique<lamella::Scene>())
{
}

vtkVesicle::~vtkVesicle() = default;

vtkAlgorithm* vtkVesicle::GetRun()
{
  return this->Reader;
}

void vtkVesicle::Prepare()
{
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
  if (!found || !SetMember(*this->Scene, found->access, std::string(value ? value : "")))
  {
    vtkErrorMacro(<< key << " = \"" << (value ? value : "") << "\" is not available"
                  << (found ? "; allowed: " + lamella::allowed_text(*found) : ""));
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
  AddTarget(this->Scene->volume.ramp, target, start_time);
  this->Modified();
}

void vtkVesicle::RemoveAllVolumeTargets()
{
  this->Scene->volume.ramp.targets.clear();
  this->Scene->volume.ramp.start_times.clear();
  this->Modified();
}

void vtkVesicle::AddAreaDifferenceTarget(double target, double start_time)
{
  AddTarget(this->Scene->area_difference.ramp, target, start_time);
  this->Modified();
}

void vtkVesicle::RemoveAllAreaDifferenceTargets()
{
  this->Scene->area_difference.ramp.targets.clear();
  this->Scene->area_difference.ramp.start_times.clear();
  this->Modified();
}
