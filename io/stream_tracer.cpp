// SPDX-License-Identifier: MIT
#include "io/stream_tracer.hpp"

#include "io/vtk_convert.hpp"

#include <vtkCellDataToPointData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkStreamTracer.h>

#include <algorithm>
#include <cmath>

namespace arenite {
namespace {

constexpr double shortest_step = 0.01, longest_step = 0.5; // of a cell
constexpr double error_limit = 1e-5;                       // of a cell, per step

/// The velocity at the grid's points, where VTK interpolates from.
vtkSmartPointer<vtkDataSet> point_velocity(ImagePiece const& image)
{
    vtkNew<vtkCellDataToPointData> filter;
    filter->SetInputData(to_vtk(image));
    filter->Update();
    vtkSmartPointer<vtkDataSet> data = filter->GetOutput();
    data->GetPointData()->SetActiveVectors("velocity");
    return data;
}

void configure(vtkStreamTracer& tracer, ImagePiece const& image, TraceRequest const& request)
{
    double const cell = *std::min_element(image.spacing.begin(), image.spacing.end());
    tracer.SetIntegratorTypeToRungeKutta45();
    tracer.SetIntegrationStepUnit(vtkStreamTracer::CELL_LENGTH_UNIT);
    tracer.SetInitialIntegrationStep(0.2);
    tracer.SetMinimumIntegrationStep(shortest_step);
    tracer.SetMaximumIntegrationStep(longest_step);
    tracer.SetMaximumError(error_limit * cell); // VTK's default, 1e-6, is a length and may be a whole cell
    tracer.SetMaximumPropagation(request.max_length);
    tracer.SetMaximumNumberOfSteps(static_cast<vtkIdType>(std::ceil(request.max_length / (shortest_step * cell))));
    tracer.SetTerminalSpeed(request.terminal_speed);
    tracer.SetComputeVorticity(false);
    if (request.direction == TraceDirection::both) tracer.SetIntegrationDirectionToBoth();
    else if (request.direction == TraceDirection::downstream) tracer.SetIntegrationDirectionToForward();
    else tracer.SetIntegrationDirectionToBackward();
}

vtkSmartPointer<vtkPolyData> seeds_inside(ImagePiece const& image, TraceRequest const& request)
{
    PolyPiece seeds;
    for (std::size_t s = 0; s + 2 < request.seeds.size(); s += 3) {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            double const offset = request.seeds[s + axis] - image.lower[axis];
            inside = inside && offset >= 0 && offset <= image.cells[axis] * image.spacing[axis];
        }
        if (inside) seeds.points.insert(seeds.points.end(), &request.seeds[s], &request.seeds[s] + 3);
    }
    return to_vtk(seeds);
}

} // namespace

bool can_trace() { return true; }

PolyPiece trace(ImagePiece const& image, TraceRequest const& request)
{
    vtkNew<vtkStreamTracer> tracer;
    tracer->SetInputData(point_velocity(image));
    tracer->SetSourceData(seeds_inside(image, request));
    configure(*tracer, image, request);
    tracer->Update();
    return lines_from_vtk(*tracer->GetOutput(), image.time);
}

} // namespace arenite
