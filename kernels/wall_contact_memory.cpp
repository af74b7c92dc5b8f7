// SPDX-License-Identifier: MIT
// Wall contacts to and from a checkpoint.
#include "kernels/wall_contacts.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <iterator>

namespace arenite {
namespace {

template <class ViewType> std::vector<Real> flatten(ViewType const& view)
{
    auto const host = Kokkos::create_mirror_view_and_copy(HostSpace(), view);
    std::vector<Real> values;
    for (std::size_t row = 0; row < host.extent(0); ++row)
        if constexpr (ViewType::rank == 2)
            for (std::size_t n = 0; n < host.extent(1); ++n) values.push_back(host(row, n));
        else values.push_back(static_cast<Real>(host(row)));
    return values;
}

template <class ViewType> ViewType unflatten(std::vector<Real> const& values, char const* label)
{
    using Value = typename ViewType::non_const_value_type;
    std::size_t constexpr width = ViewType::rank == 2 ? ViewType::static_extent(1) : 1;
    ViewType view(std::string(label), values.size() / width);
    auto const host = Kokkos::create_mirror_view(view);
    for (std::size_t n = 0; n < values.size(); ++n)
        if constexpr (ViewType::rank == 2) host(n / width, n % width) = values[n];
        else host(n) = static_cast<Value>(values[n]);
    Kokkos::deep_copy(view, host);
    return view;
}

} // namespace

std::map<std::string, std::vector<Real>> save_wall_contacts(WallContacts const& contacts)
{
    std::vector<Real> poses;
    for (WallPose const& pose : contacts.reference_pose) {
        for (int axis = 0; axis < 3; ++axis) poses.push_back(pose.position[axis]);
        poses.insert(poses.end(), std::begin(pose.rotation), std::end(pose.rotation));
    }
    return {{"reference_pose", poses},
            {"id", flatten(contacts.id)},
            {"element", flatten(contacts.element)},
            {"touching", flatten(contacts.touching)},
            {"adhering", flatten(contacts.adhering)},
            {"normal", flatten(contacts.normal)},
            {"spring", flatten(contacts.spring)},
            {"force", flatten(contacts.force)}};
}

WallContacts restore_wall_contacts(std::map<std::string, std::vector<Real>> const& arrays)
{
    WallContacts contacts;
    contacts.count = static_cast<int>(arrays.at("id").size());
    contacts.needs.history = !arrays.at("spring").empty();
    contacts.needs.bonds = !arrays.at("adhering").empty();
    std::map<std::string, std::size_t> const widths{{"element", 1}, {"touching", 1}, {"normal", 4}, {"force", 8}};
    for (auto const& [name, width] : widths)
        if (arrays.at(name).size() != width * contacts.count)
            throw InputError("checkpoint: wall contacts: the array '" + name + "' has a wrong length");
    constexpr std::size_t numbers = 12;
    std::vector<Real> const& poses = arrays.at("reference_pose");
    for (std::size_t begin = 0; begin + numbers <= poses.size(); begin += numbers) {
        WallPose& pose = contacts.reference_pose.emplace_back();
        for (int axis = 0; axis < 3; ++axis) pose.position[axis] = poses[begin + axis];
        std::copy_n(poses.begin() + static_cast<std::ptrdiff_t>(begin) + 3, 9, pose.rotation);
    }
    contacts.id = unflatten<View1<GrainId>>(arrays.at("id"), "wall_contact_id");
    contacts.element = unflatten<View1<int>>(arrays.at("element"), "wall_contact_element");
    contacts.touching = unflatten<View1<std::uint8_t>>(arrays.at("touching"), "wall_contact_touching");
    contacts.adhering = unflatten<View1<std::uint8_t>>(arrays.at("adhering"), "wall_contact_adhering");
    contacts.normal = unflatten<RecordView>(arrays.at("normal"), "wall_contact_normal");
    contacts.spring = unflatten<RecordView>(arrays.at("spring"), "wall_contact_spring");
    contacts.force = unflatten<ForceRows>(arrays.at("force"), "wall_contact_force");
    return contacts;
}

} // namespace arenite
