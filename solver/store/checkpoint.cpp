#include "store/checkpoint.h"

#include "store/frame_h5.h"
#include "store/history.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <variant>

// One description of the state, items_of(), serves to write it and to read it. Every item is a
// data set of one dimension.
namespace lamella {
namespace {

constexpr int format = 5;
constexpr const char* group_name = "checkpoint"; // in "lamella", which every frame has
constexpr const char *fields_group = "fields", *steppers_group = "field_steps";
constexpr std::size_t most_responses = 2;

/// Records as numbers, row after row.
struct Table {
  std::vector<std::string> columns;
  Array<double> numbers;
};

using Value = std::variant<std::span<double>, std::span<int>, std::span<long>, std::string*,
                           Array<double>*, Array<std::complex<double>>*, std::vector<int>*, Table*>;
struct Item {
  std::string name;
  Value value;
};
using Items = std::vector<Item>;

std::span<double> number(double& x) { return {&x, 1}; }
std::span<int> number(int& x) { return {&x, 1}; }
std::span<long> number(long& x) { return {&x, 1}; }

// -----------------------------------------------------------------------------------------------
// records

Row row_of(Domain& d) {
  return {{"x", &d.center[0]}, {"y", &d.center[1]}, {"z", &d.center[2]}, {"area", &d.area}};
}

Row row_of(CriticalPoint& p) {
  return {{"x", &p.place[0]},
          {"y", &p.place[1]},
          {"z", &p.place[2]},
          {"phi", &p.phi},
          {"stiffness_1", &p.stiffness[0]},
          {"stiffness_2", &p.stiffness[1]},
          {"stiffness_3", &p.stiffness[2]},
          {"across_x", &p.across[0]},
          {"across_y", &p.across[1]},
          {"across_z", &p.across[2]},
          {"radius", &p.radius}};
}

/// HeldAreas::Part, in numbers.
struct HeldArea {
  int is_Ld = 0;
  Vec3 center{};
  double target = 0;
};

Row row_of(HeldArea& a) {
  return {{"is_Ld", &a.is_Ld},
          {"x", &a.center[0]},
          {"y", &a.center[1]},
          {"z", &a.center[2]},
          {"target", &a.target}};
}

std::vector<std::string> columns_of(const Row& row) {
  std::vector<std::string> columns;
  for (const Field& field : row) columns.emplace_back(field.column);
  return columns;
}

template <class Record>
Table table_of(std::vector<Record> records, Record like) {
  Table table{columns_of(row_of(like)), {}};
  for (Record& record : records)
    for (const Field& field : row_of(record))
      table.numbers.push_back(std::visit([](auto* x) { return double(*x); }, field.value));
  return table;
}

/// False for a number that the field cannot take.
bool take(double number, const Field& field) {
  return std::visit(
      [&](auto* x) {
        using T = std::remove_reference_t<decltype(*x)>;
        if constexpr (std::is_same_v<T, Event::Kind>) {
          if (!(number >= 0 && number <= double(Event::Kind::thin_outside))) return false;
        } else if constexpr (std::is_same_v<T, int>) {
          if (!(std::abs(number) <= 1e9)) return false;
        }
        *x = T(number);
        return double(*x) == number;
      },
      field.value);
}

/// False for a table that is not of such records.
template <class Record>
bool take(const Table& table, Record like, std::vector<Record>& records) {
  const std::vector<std::string> columns = columns_of(row_of(like));
  if (table.columns != columns || table.numbers.size() % columns.size() != 0) return false;
  for (std::size_t n = 0; n < table.numbers.size();)
    for (const Field& field : row_of(records.emplace_back(like)))
      if (!take(table.numbers[n++], field)) return false;
  return true;
}

/// The parts of a state that are records.
struct Tables {
  Table measures, events, domains, held, inside, outside;
};

Tables tables_of(const SimulationState& s) {
  std::vector<HeldArea> held;
  for (const HeldAreas::Part& part : s.vesicle.held)
    held.push_back({part.is_Ld, part.center, part.target});
  return {table_of({s.measures}, s.measures),  table_of(s.events, Event{}),
          table_of(s.domains, Domain{true}),   table_of(held, HeldArea{}),
          table_of(s.inside, CriticalPoint{}), table_of(s.outside, CriticalPoint{})};
}

bool take(const Tables& tables, SimulationState& s) {
  std::vector<Measures> measures;
  if (!take(tables.measures, measures_with(tables.measures.columns), measures) ||
      measures.size() != 1)
    return false;
  s.measures = measures.front();
  std::vector<HeldArea> held;
  if (!take(tables.held, HeldArea{}, held)) return false;
  for (const HeldArea& area : held)
    s.vesicle.held.push_back({area.is_Ld != 0, area.center, area.target});
  return take(tables.events, Event{}, s.events) && take(tables.domains, Domain{true}, s.domains) &&
         take(tables.inside, CriticalPoint{}, s.inside) &&
         take(tables.outside, CriticalPoint{}, s.outside);
}

// -----------------------------------------------------------------------------------------------
// what a checkpoint consists of

void add(Items& items, const std::string& name, SemiImplicit::Memory& m) {
  items.insert(items.end(), {{name + "/dt", number(m.dt)},
                             {name + "/rate", &m.rate},
                             {name + "/increment", &m.increment},
                             {name + "/nodal_increment", &m.nodal_increment},
                             {name + "/last_factor", number(m.last_factor)}});
  for (std::size_t i = 0; i < m.responses.size(); i++) {
    const std::string response = fmt::format("{}/response_{}", name, i);
    items.push_back({response + "/modes", &m.responses[i].modes});
    items.push_back({response + "/nodal", &m.responses[i].nodal});
  }
}

Items items_of(Checkpoint& c, Tables& tables) {
  SimulationState& s = c.state;
  Vesicle::State& v = s.vesicle;
  Items items{{"scene", &c.scene},
              {"program", &c.program},
              {"arithmetic", &c.arithmetic},
              {"threads", number(c.threads)},
              {"wall_seconds", number(c.wall_seconds)},
              {"history_size", number(c.history.size)},
              {"history_checksum", number(c.history.checksum)},
              {"events_size", number(c.events.size)},
              {"events_checksum", number(c.events.checksum)},
              {"components_size", number(c.components.size)},
              {"components_checksum", number(c.components.checksum)},
              {"frame_times", &c.frame_times},
              {"stopping/energy_before", number(c.stopping.energy_before)},
              {"stopping/steps_at_rest", number(c.stopping.steps_at_rest)},
              {"measures", &tables.measures},
              {"events", &tables.events},
              {"domains", &tables.domains},
              {"held_areas", &tables.held},
              {"places/inside", &tables.inside},
              {"places/outside", &tables.outside},
              {"membrane/phi", &v.phi},
              {"membrane/fade", number(v.fade)},
              {"band/node", &v.band.node},
              {"band/x", &v.band.x},
              {"band/y", &v.band.y},
              {"band/z", &v.band.z},
              {"constraints/held", v.constraints.held},
              {"constraints/factor", v.constraints.factor},
              {"constraints/start", v.constraints.start},
              {"constraints/share", &v.constraints.share},
              {"constraints/group", &v.constraints.group},
              {"constraints/excess", &s.excess},
              {"vesicles/of_node", &v.vesicle_of_node},
              {"steps/error", number(s.error)},
              {"steps/last_dt", number(s.last_dt)},
              {"steps/response_dt", number(s.response_dt)},
              {"steps/history_share", number(s.history_share)},
              {"steps/made", number(s.steps)},
              {"steps/renormalised", number(s.renormalised)},
              {"steps/next_parting", number(s.next_parting)},
              {"steps/next_search", number(s.next_search)},
              {"steps/failures", number(s.failures)},
              {"steps/failed_before", number(s.failed_before)},
              {"steps/driven", number(s.driven)},
              {"box/cells", s.cells},
              {"topology/components", number(s.topology.components)},
              {"topology/genus", number(s.topology.genus)},
              {"why_not_on", &s.why_not_on}};
  add(items, "phi_steps", s.stepper);
  for (auto& [name, field] : v.fields) {
    const std::string at = std::string(fields_group) + "/" + name;
    items.push_back({at + "/coefficients", &field.coefficients});
    items.push_back({at + "/amount", number(field.amount)});
  }
  for (auto& [name, memory] : s.field_steppers)
    add(items, std::string(steppers_group) + "/" + name, memory);
  return items;
}

// -----------------------------------------------------------------------------------------------
// writing

std::size_t size_of(const Items& items) {
  std::size_t bytes = 0;
  for (const Item& item : items)
    if (const auto* a = std::get_if<Array<double>*>(&item.value))
      bytes += (*a)->size() * sizeof(double);
    else if (const auto* z = std::get_if<Array<std::complex<double>>*>(&item.value))
      bytes += (*z)->size() * sizeof(std::complex<double>);
  return bytes;
}

class ItemWriter {
public:
  explicit ItemWriter(hid_t group)
      : group_(group), properties_(creation(H5P_DATASET_CREATE)),
        links_(owned(H5Pcreate(H5P_LINK_CREATE))) {
    required(H5Pset_create_intermediate_group(links_, 1));
    required(H5Pset_attr_phase_change(properties_, 8, 6));
  }

  void write(const Item& item) {
    name_ = item.name;
    std::visit([this](const auto& value) { put(value); }, item.value);
  }

private:
  H5Handle put(hid_t file_type, hid_t memory_type, std::size_t count, const void* values) {
    const hsize_t size = count;
    const H5Handle space = owned(H5Screate_simple(1, &size, nullptr));
    H5Handle data = owned(
        H5Dcreate2(group_, name_.c_str(), file_type, space, links_, properties_, H5P_DEFAULT));
    if (count > 0) required(H5Dwrite(data, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
    return data;
  }
  void put(std::span<const double> x) {
    put(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, x.size(), x.data());
  }
  void put(std::span<double> x) { put(std::span<const double>(x)); }
  void put(std::span<int> x) { put(H5T_STD_I64LE, H5T_NATIVE_INT, x.size(), x.data()); }
  void put(std::span<long> x) { put(H5T_STD_I64LE, H5T_NATIVE_LONG, x.size(), x.data()); }
  void put(const std::string* x) { put(H5T_STD_U8LE, H5T_NATIVE_UCHAR, x->size(), x->data()); }
  void put(const Array<double>* x) { put(std::span<const double>(*x)); }
  void put(const std::vector<int>* x) { put(H5T_STD_I64LE, H5T_NATIVE_INT, x->size(), x->data()); }
  void put(const Array<std::complex<double>>* x) {
    put(std::span(reinterpret_cast<const double*>(x->data()), 2 * x->size()));
  }
  void put(const Table* x) {
    const H5Handle data =
        put(H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, x->numbers.size(), x->numbers.data());
    write_attribute(data, "columns", fmt::format("{}", fmt::join(x->columns, ",")));
  }

  hid_t group_;
  H5Handle properties_, links_;
  std::string name_;
};

// -----------------------------------------------------------------------------------------------
// reading

class ItemReader {
public:
  ItemReader(const H5Image& image, hid_t group) : image_(image), group_(group) {}

  void read(const Item& item) {
    name_ = item.name;
    std::visit([this](const auto& value) { get(value); }, item.value);
  }

private:
  [[noreturn]] void refuse(std::string_view why) const {
    image_.refuse(fmt::format("{} {}", name_, why));
  }

  H5Handle open() const {
    return image_.required(H5Dopen2(group_, name_.c_str(), H5P_DEFAULT), name_ + " is missing");
  }

  /// Of a data set that is of one dimension, not compressed, and so no larger than the file.
  std::size_t count(hid_t data, H5T_class_t of_class, std::size_t bytes) const {
    const H5Handle type = image_.required(H5Dget_type(data), name_ + " has no type");
    const H5Handle space = image_.required(H5Dget_space(data), name_ + " has no size");
    const H5Handle layout = image_.required(H5Dget_create_plist(data), name_ + " has no layout");
    hsize_t size = 0;
    if (H5Tget_class(type) != of_class || H5Tget_size(type) != bytes) refuse("is of another type");
    if (H5Sget_simple_extent_ndims(space) != 1 ||
        H5Sget_simple_extent_dims(space, &size, nullptr) != 1 ||
        H5Pget_layout(layout) != H5D_CONTIGUOUS || size > image_.size() / bytes)
      refuse("is larger than what the file can hold");
    return size;
  }

  void fetch(hid_t data, hid_t memory_type, std::size_t count, void* values) const {
    if (count > 0 && H5Dread(data, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      refuse("is damaged");
  }

  template <class T>
  void fetch_exactly(std::span<T> x, H5T_class_t of_class, hid_t memory_type) const {
    const H5Handle data = open();
    if (count(data, of_class, 8) != x.size()) refuse("has the wrong size");
    fetch(data, memory_type, x.size(), x.data());
  }

  void check_finite(std::span<const double> x) const {
    if (!std::ranges::all_of(x, [](double v) { return std::isfinite(v); }))
      refuse("has values that are not finite");
  }

  void get(std::span<double> x) const {
    fetch_exactly(x, H5T_FLOAT, H5T_NATIVE_DOUBLE);
    check_finite(x);
  }
  void get(std::span<int> x) const { fetch_exactly(x, H5T_INTEGER, H5T_NATIVE_INT); }
  void get(std::span<long> x) const { fetch_exactly(x, H5T_INTEGER, H5T_NATIVE_LONG); }
  void get(std::string* x) const {
    const H5Handle data = open();
    x->resize(count(data, H5T_INTEGER, 1));
    fetch(data, H5T_NATIVE_UCHAR, x->size(), x->data());
  }
  void get(std::vector<int>* x) const {
    const H5Handle data = open();
    x->resize(count(data, H5T_INTEGER, 8));
    fetch(data, H5T_NATIVE_INT, x->size(), x->data());
  }
  void get(hid_t data, Array<double>& x) const {
    x.resize(count(data, H5T_FLOAT, 8));
    fetch(data, H5T_NATIVE_DOUBLE, x.size(), x.data());
    check_finite(x);
  }
  void get(Array<double>* x) const { get(open(), *x); }
  void get(Array<std::complex<double>>* x) const {
    const H5Handle data = open();
    x->resize(count(data, H5T_FLOAT, 8) / 2);
    fetch_exactly(std::span(reinterpret_cast<double*>(x->data()), 2 * x->size()), H5T_FLOAT,
                  H5T_NATIVE_DOUBLE);
    check_finite({reinterpret_cast<const double*>(x->data()), 2 * x->size()});
  }
  void get(Table* x) const {
    const H5Handle data = open();
    get(data, x->numbers);
    x->columns = split(image_.text_attribute(data, "columns"));
  }

  static std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words{""};
    for (const char c : text)
      if (c == ',')
        words.emplace_back();
      else
        words.back() += c;
    return words;
  }

  const H5Image& image_;
  hid_t group_;
  std::string name_;
};

std::vector<std::string> names_in(const H5Image& image, hid_t group, const char* name) {
  if (!image.has(group, name)) return {};
  return image.names(image.group(group, name));
}

void expect_responses(const H5Image& image, hid_t group, SemiImplicit::Memory& memory) {
  const H5Handle steps = image.group(group, "phi_steps");
  while (memory.responses.size() < most_responses &&
         image.has(steps, fmt::format("response_{}", memory.responses.size()).c_str()))
    memory.responses.emplace_back();
}

} // namespace

void write_checkpoint(const std::filesystem::path& file, const Frame& frame,
                      Checkpoint checkpoint) {
  write_checkpoint(Place(file), frame, std::move(checkpoint));
}

void write_checkpoint(const Place& place, const Frame& frame, Checkpoint checkpoint) {
  check_frame(place.path(), frame);
  Tables tables = tables_of(checkpoint.state);
  const Items items = items_of(checkpoint, tables);
  write_h5(place, size_of(items) + (1 + frame.fields.size()) * frame.phi.size() * sizeof(double),
           [&](hid_t root) {
             put_frame(root, frame);
             const H5Handle lamella = owned(H5Gopen2(root, "lamella", H5P_DEFAULT));
             const H5Handle group = create_group(lamella, group_name);
             write_attribute(group, "format", std::array{format});
             ItemWriter writer(group);
             for (const Item& item : items) writer.write(item);
           });
}

bool is_checkpoint(const std::filesystem::path& file) {
  const H5Image image(file, "frame");
  return image.has(image.group(image.root(), "lamella"), group_name);
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
  const H5Image image(file, "checkpoint");
  const H5Handle lamella = image.group(image.root(), "lamella");
  if (!image.has(lamella, group_name)) image.refuse("it is a frame without a checkpoint");
  const H5Handle group = image.group(lamella, group_name);
  const int written = image.attribute<int, 1>(group, "format")[0];
  if (written != format)
    image.refuse(fmt::format("it is of format {}, this program reads {}; another version of "
                             "lamella wrote it",
                             written, format));
  Checkpoint checkpoint;
  SimulationState& state = checkpoint.state;
  expect_responses(image, group, state.stepper);
  for (const std::string& name : names_in(image, group, fields_group)) state.vesicle.fields[name];
  for (const std::string& name : names_in(image, group, steppers_group)) state.field_steppers[name];
  Tables tables;
  ItemReader reader(image, group);
  for (const Item& item : items_of(checkpoint, tables)) reader.read(item);
  if (!take(tables, state)) image.refuse("its tables are not those of this program");
  return checkpoint;
}

} // namespace lamella
