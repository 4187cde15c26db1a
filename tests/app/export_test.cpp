#include "cli.h"

#include <gmock/gmock.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTriangle.h>
#include <vtkXMLPolyDataReader.h>

// lamella export, read back with VTK's readers.
namespace lamella {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

vtkSmartPointer<vtkPolyData> polygons_in(const fs::path& file) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

double area_of(vtkPolyData& mesh) {
  double area = 0;
  for (vtkIdType n = 0; n < mesh.GetNumberOfCells(); ++n)
    area += vtkTriangle::SafeDownCast(mesh.GetCell(n))->ComputeArea();
  return area;
}

std::set<std::string> arrays_of(vtkPolyData& polygons) {
  std::set<std::string> names;
  for (int n = 0; n < polygons.GetPointData()->GetNumberOfArrays(); ++n)
    names.insert(polygons.GetPointData()->GetArrayName(n));
  return names;
}

TEST_F(Cli, exports_membranes_as_triangles) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  const Result result = call(words("export run"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "run/surfaces/membrane.pvd\n");
  EXPECT_THAT(names_in(work() / "run" / "surfaces"),
              ElementsAre("membrane.pvd", "membrane_0000.vtp", "membrane_0001.vtp",
                          "membrane_0002.vtp", "membrane_0003.vtp", "membrane_0004.vtp"));
  EXPECT_THAT(text_of(work() / "run" / "surfaces" / "membrane.pvd"),
              HasSubstr("timestep=\"1e-05\" file=\"membrane_0002.vtp\""));

  const auto mesh = polygons_in(work() / "run" / "surfaces" / "membrane_0004.vtp");
  const double area = read_history(work() / "run" / "history.csv").back().area;
  EXPECT_NEAR(area_of(*mesh), area, 2e-3 * area);
  EXPECT_THAT(arrays_of(*mesh), ElementsAre("K", "K_M", "Normals", "energy_density", "velocity"));
}

TEST_F(Cli, exports_two_phases_with_their_boundary_at_the_times_asked_for) {
  ASSERT_EQ(call(words("run fig9 --no-pictures --set grid.nodes=32 --set run.end_time=4e-5 "
                       "--set output.frames=5 -o run"))
                .code,
            0);
  const Result result = call(words("export run -o meshes --times 4e-5,1.1e-5,0.9e-5"));
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.out, "meshes/membrane.pvd\nmeshes/boundary.pvd\n");
  EXPECT_THAT(names_in(work() / "meshes"),
              ElementsAre("boundary.pvd", "boundary_0001.vtp", "boundary_0004.vtp", "membrane.pvd",
                          "membrane_0001.vtp", "membrane_0004.vtp"));
  const auto lines = polygons_in(work() / "meshes" / "boundary_0004.vtp");
  const Measures end = read_history(work() / "run" / "history.csv").back();
  ASSERT_EQ(lines->GetNumberOfCells(), 1);
  EXPECT_NEAR(lines->GetCellData()->GetArray("length")->GetTuple1(0), end.phases->line_length,
              2e-3 * end.phases->line_length);
  EXPECT_TRUE(arrays_of(*polygons_in(work() / "meshes" / "membrane_0004.vtp")).contains("phase"));
}

TEST_F(Cli, replaces_what_it_exported_and_nothing_else) {
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  ASSERT_EQ(call(words("export run")).code, 0);
  const fs::path surfaces = work() / "run" / "surfaces";
  write(surfaces / "mine.txt", "mine");
  EXPECT_EQ(call(words("export run --times 0")).code, 0);
  EXPECT_THAT(names_in(surfaces), ElementsAre("membrane.pvd", "membrane_0000.vtp", "mine.txt"));
  EXPECT_EQ(call(quick({"-o", "run", "--force"})).code, 0);
  EXPECT_THAT(names_in(surfaces), ElementsAre("mine.txt")) << "not those of the run before";
}

TEST_F(Cli, says_why_it_cannot_export) {
  EXPECT_THAT(call(words("export nothing")).err, HasSubstr("nothing"));
  ASSERT_EQ(call(quick({"-o", "run"})).code, 0);
  fs::resize_file(work() / "run" / "frames" / "frame_0002.hdf", 5000);
  const Result damaged = call(words("export run"));
  EXPECT_EQ(damaged.code, 4);
  EXPECT_THAT(damaged.err, HasSubstr("frame_0002.hdf"));
  EXPECT_EQ(std::ranges::count(damaged.err, '\n'), 1) << damaged.err;
  write(work() / "file", "");
  EXPECT_EQ(call(words("export run -o file")).code, 4);
  setting_.largest_file = 3000;
  const Result full = call(words("export run --times 0"));
  EXPECT_EQ(full.code, 4);
  EXPECT_THAT(full.err, HasSubstr("File too large"));
  EXPECT_FALSE(fs::exists(work() / "run" / "surfaces"));
}

} // namespace
} // namespace lamella
