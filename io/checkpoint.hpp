// SPDX-License-Identifier: MIT
// Checkpoints: named arrays and values in one HDF5 file, bit for bit, under a checksum. What the
// state consists of is the business of those who own it; they add their arrays under names of their own
// ("contacts/history"). Where HDF5 is left out, writing and reading throw one clear message.
//
//   CheckpointWriter out(checkpoint_path(folder, step), stamp);
//   out.array("particles/position", particles.position);
//   out.value("fluid/time", time);
//   out.commit();
#pragma once

#include "core/types.hpp"
#include "io/checkpoint_element.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace arenite {

bool can_write_checkpoints();

/// What a checkpoint belongs to; readable without reading the state.
struct CheckpointStamp {
    std::int64_t step = 0;
    Real time = 0; // s
    std::string stage;
    bool stage_end = false; // the last state of its stage; kept for good
    std::uint64_t scene_hash = 0;
};

class CheckpointWriter {
public:
    CheckpointWriter(std::filesystem::path path, CheckpointStamp const& stamp); // throws OutputError
    ~CheckpointWriter();                                                        // without commit() nothing is left
    CheckpointWriter(CheckpointWriter const&) = delete;
    CheckpointWriter& operator=(CheckpointWriter const&) = delete;

    /// A View of any rank up to 3, space and layout (stored with the last index fastest) ...
    template <class T, class... P> void array(std::string const& name, Kokkos::View<T, P...> const& view);
    /// ... or a vector.
    template <class T> void array(std::string const& name, std::vector<T> const& values)
    {
        std::vector<std::size_t> const shape{values.size()}; // named: nvcc takes a braced argument here for the vector
        write(name, ElementOf<T>::kind, shape, values.data());
    }
    /// One number.
    template <class T> void value(std::string const& name, T number) { write(name, ElementOf<T>::kind, {1}, &number); }
    /// Text of any length.
    void text(std::string const& name, std::string const& content)
    {
        write(name, Element::text, {content.size()}, content.data());
    }

    /// The file appears under its name. Throws OutputError with the cause if it cannot.
    void commit();

private:
    struct File;
    void write(std::string const& name, Element kind, std::vector<std::size_t> const& shape, void const* data);

    std::unique_ptr<File> file_;
};

/// Every fault is an InputError that names the file: missing, truncated, foreign, of another version,
/// damaged, without the array, or with an array of another type or shape.
class CheckpointReader {
public:
    explicit CheckpointReader(std::filesystem::path path);
    ~CheckpointReader();
    CheckpointReader(CheckpointReader const&) = delete;
    CheckpointReader& operator=(CheckpointReader const&) = delete;

    CheckpointStamp const& stamp() const;
    void require_scene(std::uint64_t hash) const; // throws if it was written for another scene; 0: one without its stage

    bool has(std::string const& name) const;
    std::vector<std::string> names() const; // all, sorted
    std::vector<std::size_t> shape(std::string const& name) const;

    template <class T> std::vector<T> array(std::string const& name) const
    {
        std::vector<T> values(size_of(shape_checked(name, ElementOf<T>::kind, 1)));
        read(name, values.data());
        return values;
    }
    template <class T> T value(std::string const& name) const
    {
        auto const values = array<T>(name);
        require_one(name, values.size());
        return values.front();
    }
    std::string text(std::string const& name) const
    {
        std::string content(size_of(shape_checked(name, Element::text, 1)), '\0');
        read(name, content.data());
        return content;
    }
    /// Allocates the View to the stored shape and fills it.
    template <class T, class... P> void view(std::string const& name, Kokkos::View<T, P...>& target) const;

    /// Compares the checksum. Done before any array is read, too; not for the stamp alone.
    void verify() const;

private:
    struct File;
    std::vector<std::size_t> shape_checked(std::string const& name, Element kind, std::size_t rank) const;
    void require_extent(std::string const& name, std::size_t axis, std::size_t expected) const;
    void require_one(std::string const& name, std::size_t found) const;
    void read(std::string const& name, void* target) const;

    std::unique_ptr<File> file_;
};

// ------------------------------------------------------------------------------------------ Views

template <class T, class... P> void CheckpointWriter::array(std::string const& name, Kokkos::View<T, P...> const& view)
{
    using ViewType = Kokkos::View<T, P...>;
    auto const host = host_rows(view);
    write(name, ElementOf<typename ViewType::non_const_value_type>::kind, shape_of(view), host.data());
}

template <class T, class... P> void CheckpointReader::view(std::string const& name, Kokkos::View<T, P...>& target) const
{
    using ViewType = Kokkos::View<T, P...>;
    auto const shape = shape_checked(name, ElementOf<typename ViewType::value_type>::kind, ViewType::rank);
    for (std::size_t axis = ViewType::rank_dynamic; axis < ViewType::rank; ++axis)
        require_extent(name, axis, ViewType::static_extent(axis));
    target = allocated<ViewType>(name, shape);
    auto const rows = allocated<HostRows<ViewType>>(name, shape);
    read(name, rows.data());
    auto const mirror = Kokkos::create_mirror_view(Kokkos::WithoutInitializing, target);
    Kokkos::deep_copy(mirror, rows); // changes the layout, on the host
    Kokkos::deep_copy(target, mirror);
}

} // namespace arenite
