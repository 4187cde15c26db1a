#include "fields/state_data.h"

#include "fields/field_data.h"
#include "fields/image.h"
#include "store/history.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>

#include <string>
#include <vector>

namespace lamella {
namespace {

bool is_text(const Field& field) { return std::holds_alternative<Event::Kind*>(field.value); }

double number_in(const Field& field) {
  if (const auto* real = std::get_if<double*>(&field.value)) return **real;
  return *std::get<int*>(field.value);
}

std::string text_in(const Field& field) {
  return std::string(to_string(*std::get<Event::Kind*>(field.value)));
}

void add_column(vtkTable& table, const Field& field) {
  auto column = is_text(field) ? vtkSmartPointer<vtkAbstractArray>(vtkNew<vtkStringArray>())
                               : vtkSmartPointer<vtkAbstractArray>(vtkNew<vtkDoubleArray>());
  column->SetName(std::string(field.column).c_str());
  table.AddColumn(column);
}

void append(vtkAbstractArray& column, const Field& field) {
  if (is_text(field))
    vtkStringArray::SafeDownCast(&column)->InsertNextValue(text_in(field));
  else
    vtkDoubleArray::SafeDownCast(&column)->InsertNextValue(number_in(field));
}

/// The records (measures, events) in the columns that one like them has.
template <class Record>
void fill_table(vtkTable& table, std::span<const Record> records, Record like) {
  table.Initialize();
  for (const Field& field : row_of(like)) add_column(table, field);
  for (Record record : records) {
    vtkIdType index = 0;
    for (const Field& field : row_of(record)) append(*table.GetColumn(index++), field);
  }
}

} // namespace

void fill_state(vtkImageData& image, const Frame& frame, const Measures& measures,
                const Scene& scene, int vesicles, const Vec3& center) {
  fill_image(image, frame, center);
  Measures copy = measures;
  for (const Field& field : row_of(copy))
    set_field_value(image, std::string(field.column), number_in(field));
  if (vesicles > 1) set_field_value(image, "vesicles", vesicles);
  set_forces(image, scene);
}

void fill_history(vtkTable& table, std::span<const Measures> history) {
  fill_table(table, history, history.empty() ? Measures() : history.front());
}

void fill_events(vtkTable& table, std::span<const Event> events, const Vec3& center) {
  std::vector<Event> moved(events.begin(), events.end());
  for (Event& event : moved)
    for (int a = 0; a < 3; ++a) event.place[a] += center[a];
  fill_table<Event>(table, moved, Event());
}

void fill_components(vtkTable& table, std::span<const ComponentMeasures> vesicles,
                     const Vec3& center) {
  std::vector<ComponentMeasures> moved(vesicles.begin(), vesicles.end());
  for (ComponentMeasures& vesicle : moved)
    for (int a = 0; a < 3; ++a) vesicle.center[a] += center[a];
  fill_table<ComponentMeasures>(table, moved, moved.empty() ? ComponentMeasures() : moved.front());
}

} // namespace lamella
