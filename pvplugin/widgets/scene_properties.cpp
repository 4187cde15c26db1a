#include "widgets/scene_properties.h"

#include "proxies/names.h"
#include "scene/scene_toml.h"

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

namespace lamella
{
namespace
{

/// Sets one property, for each type of parameter.
struct Setter
{
  vtkSMProxy& proxy;
  const Key& key;
  Scene& scene;

  vtkSMPropertyHelper property() const { return { &proxy, property_name(key).c_str() }; }

  void operator()(Member<double> x) const { property().Set(x(scene)); }
  void operator()(Member<int> n) const { property().Set(n(scene)); }
  void operator()(Member<bool> flag) const { property().Set(int(flag(scene))); }
  void operator()(Member<std::string> text) const { property().Set(text(scene).c_str()); }
  void operator()(Member<Parameters>) const { property().Set(value_text(key, scene).c_str()); }
  void operator()(Member<MaterialFields> fields) const
  {
    property().Set(text_of(fields(scene)).c_str());
  }
  void operator()(Member<Vec3> x) const { property().Set(x(scene).data(), 3); }
  void operator()(Member<std::array<int, 3>> n) const { property().Set(n(scene).data(), 3); }
  void operator()(const Choice& choice) const
  {
    property().Set(std::string(choice.names.at(std::size_t(choice.get(scene)))).c_str());
  }
  void operator()(Member<std::vector<double>> list) const
  {
    if (key.name == "start_times")
      return; // set with the targets
    const Ramp& ramp = key.section == "volume" ? scene.volume.ramp : scene.area_difference.ramp;
    std::vector<double> pairs;
    for (std::size_t n = 0; n < list(scene).size(); ++n)
      pairs.insert(pairs.end(), { ramp.targets[n], ramp.start_times[n] });
    set_list(pairs);
  }
  void operator()(Member<std::vector<Vec3>> list) const
  {
    std::vector<double> numbers;
    for (const Vec3& x : list(scene))
      numbers.insert(numbers.end(), x.begin(), x.end());
    set_list(numbers);
  }
  void set_list(const std::vector<double>& numbers) const
  {
    property().SetNumberOfElements(unsigned(numbers.size()));
    property().Set(numbers.data(), unsigned(numbers.size()));
  }
};

} // namespace

void set_properties(vtkSMProxy& vesicle, Scene scene)
{
  for (const Key& key : scene_keys())
    if (!key.section.empty() || key.name == "fields") // a name and a title are for files
      std::visit(Setter{ vesicle, key, scene }, key.access);
}

} // namespace lamella
