// SPDX-License-Identifier: MIT
// Several numbers in one: what the pair kernel and the exchange with the fluid compute with, so that one instruction works
// on as many contacts or grains as the processor's vector unit holds. Contact laws and drag laws are templates on the
// number: Real where one is looked at (walls, tests, reports) and on a GPU, whose threads are its lanes; Lanes in those
// kernels.
//
// A branch per contact becomes select(mask, a, b); what is rare and dear stays behind `if (any(mask))`. Every
// lane goes through the same instructions, so a contact's bits do not depend on who shares its vector.
//
// The lanes are those of the Parallelism TS (ISO/IEC TS 19570, libstdc++ 11 and later), not Kokkos', whose AVX-512
// comparisons a > b and a >= b mean b > a and b >= a in 4.5.1. Without the header there is one lane.
#pragma once

#include "core/vec3.hpp"

#if !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP) && !defined(KOKKOS_ENABLE_SYCL) && __has_include(<experimental/simd>)
#define ARENITE_HOST_LANES
#include <cstring>
#include <experimental/simd>
#ifdef __AVX__
#include <immintrin.h>
#endif
#endif

namespace arenite {

template <class N> struct NumberTraits { // of one number
    using Mask = bool;
    static constexpr int lanes = 1;
};

KOKKOS_FORCEINLINE_FUNCTION Real select(bool mask, Real a, Real b) { return mask ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION bool select(bool mask, bool a, bool b) { return mask ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION bool any(bool mask) { return mask; }
KOKKOS_FORCEINLINE_FUNCTION bool all(bool mask) { return mask; }
// The second number where one is NaN.
KOKKOS_FORCEINLINE_FUNCTION Real larger(Real a, Real b) { return a > b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION Real smaller(Real a, Real b) { return a < b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION Real magnitude(Real a) { return Kokkos::fabs(a); }
KOKKOS_FORCEINLINE_FUNCTION Real square_root(Real a) { return Kokkos::sqrt(a); }
// Within two roundings; of 0 and infinity any number or NaN.
KOKKOS_FORCEINLINE_FUNCTION Real reciprocal(Real a) { return 1 / a; }
KOKKOS_FORCEINLINE_FUNCTION Real inverse_root(Real a) { return 1 / a * Kokkos::sqrt(a); } // both at the same time
KOKKOS_FORCEINLINE_FUNCTION Real rounded_down(Real a) { return Kokkos::floor(a); }
// Lanes within four units of the last digit; of 0, infinity and NaN what the C library says.
KOKKOS_FORCEINLINE_FUNCTION Real exponential(Real a) { return Kokkos::exp(a); }
KOKKOS_FORCEINLINE_FUNCTION Real logarithm(Real a) { return Kokkos::log(a); }
KOKKOS_FORCEINLINE_FUNCTION Real power(Real a, Real exponent) { return Kokkos::pow(a, exponent); }
KOKKOS_FORCEINLINE_FUNCTION Real lane(Real a, int) { return a; }
KOKKOS_FORCEINLINE_FUNCTION Real sum_of_lanes(Real a) { return a; }

#ifdef ARENITE_HOST_LANES

using Lanes = std::experimental::native_simd<Real>;
using LaneMask = Lanes::mask_type;
template <> struct NumberTraits<Lanes> {
    using Mask = LaneMask;
    static constexpr int lanes = static_cast<int>(Lanes::size());
};

KOKKOS_FORCEINLINE_FUNCTION Lanes select(LaneMask const& mask, Lanes const& a, Lanes const& b)
{
    Lanes result = b;
    where(mask, result) = a;
    return result;
}
KOKKOS_FORCEINLINE_FUNCTION LaneMask select(LaneMask const& mask, LaneMask const& a, LaneMask const& b)
{
    return (mask && a) || (!mask && b);
}
KOKKOS_FORCEINLINE_FUNCTION bool any(LaneMask const& mask) { return any_of(mask); }
KOKKOS_FORCEINLINE_FUNCTION bool all(LaneMask const& mask) { return all_of(mask); }
// One instruction with the same answer, also for NaN; compilers see two in the comparison and the choice.
#if defined(__AVX512F__)
KOKKOS_FORCEINLINE_FUNCTION Lanes larger(Lanes const& a, Lanes const& b)
{
    return Lanes(_mm512_max_pd(static_cast<__m512d>(a), static_cast<__m512d>(b)));
}
KOKKOS_FORCEINLINE_FUNCTION Lanes smaller(Lanes const& a, Lanes const& b)
{
    return Lanes(_mm512_min_pd(static_cast<__m512d>(a), static_cast<__m512d>(b)));
}
#elif defined(__AVX__)
KOKKOS_FORCEINLINE_FUNCTION Lanes larger(Lanes const& a, Lanes const& b)
{
    return Lanes(_mm256_max_pd(static_cast<__m256d>(a), static_cast<__m256d>(b)));
}
KOKKOS_FORCEINLINE_FUNCTION Lanes smaller(Lanes const& a, Lanes const& b)
{
    return Lanes(_mm256_min_pd(static_cast<__m256d>(a), static_cast<__m256d>(b)));
}
#else
KOKKOS_FORCEINLINE_FUNCTION Lanes larger(Lanes const& a, Lanes const& b) { return select(a > b, a, b); }
KOKKOS_FORCEINLINE_FUNCTION Lanes smaller(Lanes const& a, Lanes const& b) { return select(a < b, a, b); }
#endif
KOKKOS_FORCEINLINE_FUNCTION Lanes magnitude(Lanes const& a) { return abs(a); }
KOKKOS_FORCEINLINE_FUNCTION Lanes square_root(Lanes const& a) { return sqrt(a); }
#if defined(__AVX512F__) && !defined(__znver3__) && !defined(__znver4__) && !defined(__znver5__)
// An Intel core's divider is busy with eight numbers for 16 cycles (a quotient) or 24 (a root), one after the other. The
// processor's estimate is good to 14 bits; a series in what it is off by, down to a rounding, goes through the multipliers.
// On another maker's processor the same program would give other last bits: its estimates differ.
namespace lanes_detail {
/// a b + c, rounded once, whatever the flags of the file that includes this.
KOKKOS_FORCEINLINE_FUNCTION Lanes fused(Lanes const& a, Lanes const& b, Lanes const& c)
{
    return Lanes(_mm512_fmadd_pd(static_cast<__m512d>(a), static_cast<__m512d>(b), static_cast<__m512d>(c)));
}
} // namespace lanes_detail
KOKKOS_FORCEINLINE_FUNCTION Lanes reciprocal(Lanes const& a)
{
    using lanes_detail::fused;
    Lanes const estimate(_mm512_rcp14_pd(static_cast<__m512d>(a)));
    Lanes const off = fused(-a, estimate, 1), better = fused(estimate, off, estimate);
    return fused(off * off, better, better); // 1 + off + off^2 + off^3
}
KOKKOS_FORCEINLINE_FUNCTION Lanes inverse_root(Lanes const& a)
{
    using lanes_detail::fused;
    Lanes const estimate(_mm512_rsqrt14_pd(static_cast<__m512d>(a)));
    Lanes const off = fused(-(a * estimate), 0.5 * estimate, 0.5);
    Lanes const series = fused(off, fused(off, 2.5, 1.5), 1); // 1 / sqrt(1 - 2 off) = 1 + off series
    return fused(estimate * off, series, estimate);
}
#else
KOKKOS_FORCEINLINE_FUNCTION Lanes reciprocal(Lanes const& a) { return 1 / a; }
KOKKOS_FORCEINLINE_FUNCTION Lanes inverse_root(Lanes const& a) { return 1 / a * sqrt(a); }
#endif
KOKKOS_FORCEINLINE_FUNCTION Lanes rounded_down(Lanes const& a) { return floor(a); }
#if defined(__GLIBC__) && defined(__x86_64__)
// The C library's vector functions, by the names that the vector ABI gives them.
namespace lanes_detail {
#if defined(__AVX512F__)
#define ARENITE_VECTOR_FUNCTION(name) __asm__("_ZGVeN8" name)
using VectorRegister = __m512d;
#elif defined(__AVX2__)
#define ARENITE_VECTOR_FUNCTION(name) __asm__("_ZGVdN4" name)
using VectorRegister = __m256d;
#elif defined(__AVX__)
#define ARENITE_VECTOR_FUNCTION(name) __asm__("_ZGVcN4" name)
using VectorRegister = __m256d;
#else
#define ARENITE_VECTOR_FUNCTION(name) __asm__("_ZGVbN2" name)
using VectorRegister __attribute__((vector_size(16))) = Real;
#endif
VectorRegister exponential(VectorRegister) ARENITE_VECTOR_FUNCTION("v_exp");
VectorRegister logarithm(VectorRegister) ARENITE_VECTOR_FUNCTION("v_log");
VectorRegister power(VectorRegister, VectorRegister) ARENITE_VECTOR_FUNCTION("vv_pow");
#undef ARENITE_VECTOR_FUNCTION
KOKKOS_FORCEINLINE_FUNCTION VectorRegister in_register(Lanes const& a) { return static_cast<VectorRegister>(a); }
} // namespace lanes_detail
KOKKOS_FORCEINLINE_FUNCTION Lanes exponential(Lanes const& a)
{
    return Lanes(lanes_detail::exponential(lanes_detail::in_register(a)));
}
KOKKOS_FORCEINLINE_FUNCTION Lanes logarithm(Lanes const& a)
{
    return Lanes(lanes_detail::logarithm(lanes_detail::in_register(a)));
}
KOKKOS_FORCEINLINE_FUNCTION Lanes power(Lanes const& a, Lanes const& exponent)
{
    return Lanes(lanes_detail::power(lanes_detail::in_register(a), lanes_detail::in_register(exponent)));
}
#else
KOKKOS_FORCEINLINE_FUNCTION Lanes exponential(Lanes const& a) { return exp(a); }
KOKKOS_FORCEINLINE_FUNCTION Lanes logarithm(Lanes const& a) { return log(a); }
KOKKOS_FORCEINLINE_FUNCTION Lanes power(Lanes const& a, Lanes const& exponent) { return pow(a, exponent); }
#endif
KOKKOS_FORCEINLINE_FUNCTION Real lane(Lanes const& a, int n) { return a[n]; }
KOKKOS_FORCEINLINE_FUNCTION Real sum_of_lanes(Lanes const& a) { return reduce(a); }

#else

using Lanes = Real;
using LaneMask = bool;

#endif

inline constexpr int lane_count = NumberTraits<Lanes>::lanes;
template <class N> using MaskOf = typename NumberTraits<N>::Mask;

/// Groups of as many items as there are lanes.
KOKKOS_FORCEINLINE_FUNCTION constexpr int lane_groups(int items) { return (items + lane_count - 1) / lane_count; }
/// The items of a group; beyond the last one the last again.
KOKKOS_FORCEINLINE_FUNCTION void items_of_group(int group, int items, int (&item)[lane_count])
{
    for (int n = 0; n < lane_count; ++n) {
        int const own = group * lane_count + n;
        item[n] = own < items ? own : items - 1;
    }
}

template <class N>
KOKKOS_FORCEINLINE_FUNCTION Vector<N> select(MaskOf<N> const& mask, Vector<N> const& a, Vector<N> const& b)
{
    return {select(mask, a.x, b.x), select(mask, a.y, b.y), select(mask, a.z, b.z)};
}

/// Consecutive numbers from memory and back.
KOKKOS_FORCEINLINE_FUNCTION Lanes load_lanes(Real const* from)
{
#ifdef ARENITE_HOST_LANES
    return Lanes(from, std::experimental::element_aligned);
#else
    return *from;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION void store_lanes(Lanes const& lanes, Real* to)
{
#ifdef ARENITE_HOST_LANES
    lanes.copy_to(to, std::experimental::element_aligned);
#else
    *to = lanes;
#endif
}

/// Consecutive flags, 0 or 1 each.
KOKKOS_FORCEINLINE_FUNCTION LaneMask load_flags(std::uint8_t const* from)
{
#ifdef ARENITE_HOST_LANES
    bool flags[lane_count];
    std::memcpy(flags, from, lane_count);
    return LaneMask(flags, std::experimental::element_aligned);
#else
    return *from != 0;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION void store_flags(LaneMask const& mask, std::uint8_t* to)
{
#ifdef ARENITE_HOST_LANES
    bool flags[lane_count];
    mask.copy_to(flags, std::experimental::element_aligned);
    std::memcpy(to, flags, lane_count);
#else
    *to = mask;
#endif
}

/// One number a lane: make(n) is lane n's.
template <class Make> KOKKOS_FORCEINLINE_FUNCTION Lanes make_lanes(Make const& make)
{
#ifdef ARENITE_HOST_LANES
    return Lanes([&](auto n) { return make(static_cast<int>(n)); });
#else
    return make(0);
#endif
}

/// One record of four numbers, which one instruction works on.
#ifdef ARENITE_HOST_LANES
using Quad __attribute__((vector_size(32))) = Real;
#else
struct Quad {
    Real number[4] = {};
    KOKKOS_FUNCTION Real operator[](int n) const { return number[n]; }
    KOKKOS_FUNCTION friend Quad operator*(Real factor, Quad const& q)
    {
        return {{factor * q[0], factor * q[1], factor * q[2], factor * q[3]}};
    }
    KOKKOS_FUNCTION friend Quad operator*(Quad const& a, Quad const& b)
    {
        return {{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]}};
    }
    KOKKOS_FUNCTION friend Quad operator+(Quad const& a, Quad const& b)
    {
        return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}};
    }
    KOKKOS_FUNCTION friend Quad operator-(Quad const& a, Quad const& b)
    {
        return {{a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}};
    }
    KOKKOS_FUNCTION Quad& operator+=(Quad const& q)
    {
        for (int n = 0; n < 4; ++n) number[n] += q[n];
        return *this;
    }
    KOKKOS_FUNCTION Quad& operator-=(Quad const& q)
    {
        for (int n = 0; n < 4; ++n) number[n] -= q[n];
        return *this;
    }
};
#endif

KOKKOS_FORCEINLINE_FUNCTION Quad load_quad(Real const* from)
{
#ifdef ARENITE_HOST_LANES
    Quad quad;
    std::memcpy(&quad, from, sizeof quad);
    return quad;
#else
    return {{from[0], from[1], from[2], from[3]}};
#endif
}

/// From a View of records and back. Its rows begin at multiples of 16 bytes, and a GPU moves such pairs in one access: half
/// as many, and accesses to scattered records are what its kernels wait for.
struct alignas(16) RealPair {
    Real a, b;
};
KOKKOS_FORCEINLINE_FUNCTION Quad load_record(Real const* from)
{
#ifdef ARENITE_HOST_LANES
    return load_quad(from);
#else
    RealPair const low = *reinterpret_cast<RealPair const*>(from), high = *reinterpret_cast<RealPair const*>(from + 2);
    return {{low.a, low.b, high.a, high.b}};
#endif
}
KOKKOS_FORCEINLINE_FUNCTION void store_record(Quad const& record, Real* to)
{
#ifdef ARENITE_HOST_LANES
    std::memcpy(to, &record, sizeof record);
#else
    *reinterpret_cast<RealPair*>(to) = {record[0], record[1]};
    *reinterpret_cast<RealPair*>(to + 2) = {record[2], record[3]};
#endif
}

/// -quad where odd is 1, quad where it is 0.
KOKKOS_FORCEINLINE_FUNCTION Quad negated_if(int odd, Quad const& quad)
{
#ifdef ARENITE_HOST_LANES
    using Bits __attribute__((vector_size(32))) = std::int64_t;
    return Quad(Bits(quad) ^ ((Bits{} + odd) << 63));
#else
    return Real(1 - 2 * odd) * quad;
#endif
}

/// `size`, component by component, with the sign of `direction`; 0 where that is 0.
KOKKOS_FORCEINLINE_FUNCTION Quad along(Quad const& direction, Quad const& size)
{
#ifdef ARENITE_HOST_LANES
    Quad const zero{};
    return direction > zero ? size : (direction < zero ? -size : zero);
#else
    auto const one = [&](int n) { return direction[n] > 0 ? size[n] : direction[n] < 0 ? -size[n] : Real(0); };
    return {{one(0), one(1), one(2), one(3)}};
#endif
}
KOKKOS_FORCEINLINE_FUNCTION Quad magnitude(Quad const& q) { return along(q, q); }

KOKKOS_FORCEINLINE_FUNCTION Quad quad_of(Vec3 const& v) { return Quad{v.x, v.y, v.z, 0}; }
KOKKOS_FORCEINLINE_FUNCTION Quad three_times(Real a) { return Quad{a, a, a, 0}; }
KOKKOS_FORCEINLINE_FUNCTION Real sum_of_three(Quad const& q) { return q[0] + q[1] + q[2]; }

/// A record of four numbers in every lane.
struct LaneRecords {
    Vector<Lanes> xyz;
    Lanes w;
};

// A width is compiled for where it is the processor's: the other would not even parse.
#if defined(ARENITE_HOST_LANES) && defined(__AVX__) && __has_builtin(__builtin_shufflevector)
#define ARENITE_TURNS_IN_REGISTERS
// Whole records are moved and turned in registers: with eight lanes 2 memory accesses and 3 shuffles for 8 numbers, where
// number by number it takes 8 and 7; with four lanes 1 access and 2 shuffles for 4 numbers in place of 4 and 3.
namespace lanes_detail {

#ifdef __AVX512F__

using Octet __attribute__((vector_size(64))) = Real;

/// quad(n): lane n's record.
template <class Quads> [[gnu::always_inline]] inline LaneRecords turn(Quads const& quad)
{
    Octet row[4]; // of lanes n and n + 4
    for (int n = 0; n < 4; ++n) row[n] = _mm512_insertf64x4(_mm512_castpd256_pd512(quad(n)), quad(n + 4), 1);
    Octet const xz01 = __builtin_shufflevector(row[0], row[1], 0, 8, 2, 10, 4, 12, 6, 14);
    Octet const yw01 = __builtin_shufflevector(row[0], row[1], 1, 9, 3, 11, 5, 13, 7, 15);
    Octet const xz23 = __builtin_shufflevector(row[2], row[3], 0, 8, 2, 10, 4, 12, 6, 14);
    Octet const yw23 = __builtin_shufflevector(row[2], row[3], 1, 9, 3, 11, 5, 13, 7, 15);
    return {{Lanes(__builtin_shufflevector(xz01, xz23, 0, 1, 8, 9, 4, 5, 12, 13)),
             Lanes(__builtin_shufflevector(yw01, yw23, 0, 1, 8, 9, 4, 5, 12, 13)),
             Lanes(__builtin_shufflevector(xz01, xz23, 2, 3, 10, 11, 6, 7, 14, 15))},
            Lanes(__builtin_shufflevector(yw01, yw23, 2, 3, 10, 11, 6, 7, 14, 15))};
}

/// Lane n's record to place(n).
template <class Places> [[gnu::always_inline]] inline void store(LaneRecords const& records, Places const& place)
{
    auto const x = static_cast<Octet>(records.xyz.x), y = static_cast<Octet>(records.xyz.y),
               z = static_cast<Octet>(records.xyz.z), w = static_cast<Octet>(records.w);
    Octet const xy0 = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14),
                zw0 = __builtin_shufflevector(z, w, 0, 8, 2, 10, 4, 12, 6, 14);
    Octet const xy1 = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15),
                zw1 = __builtin_shufflevector(z, w, 1, 9, 3, 11, 5, 13, 7, 15);
    Octet const row[4] = {__builtin_shufflevector(xy0, zw0, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy1, zw1, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy0, zw0, 2, 3, 10, 11, 6, 7, 14, 15),
                          __builtin_shufflevector(xy1, zw1, 2, 3, 10, 11, 6, 7, 14, 15)};
    for (int n = 0; n < 4; ++n) {
        _mm256_storeu_pd(place(n), _mm512_castpd512_pd256(row[n]));
        _mm256_storeu_pd(place(n + 4), _mm512_extractf64x4_pd(row[n], 1));
    }
}

#else

/// Numbers n of the four records, for n = 0 to 3; its own inverse.
[[gnu::always_inline]] inline void transpose(Quad (&row)[4])
{
    Quad const xz01 = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6),
               yw01 = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7),
               xz23 = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6),
               yw23 = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
    row[0] = __builtin_shufflevector(xz01, xz23, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(yw01, yw23, 0, 1, 4, 5);
    row[2] = __builtin_shufflevector(xz01, xz23, 2, 3, 6, 7);
    row[3] = __builtin_shufflevector(yw01, yw23, 2, 3, 6, 7);
}

/// quad(n): lane n's record.
template <class Quads> [[gnu::always_inline]] inline LaneRecords turn(Quads const& quad)
{
    Quad row[4] = {quad(0), quad(1), quad(2), quad(3)};
    transpose(row);
    return {{Lanes(row[0]), Lanes(row[1]), Lanes(row[2])}, Lanes(row[3])};
}

/// Lane n's record to place(n).
template <class Places> [[gnu::always_inline]] inline void store(LaneRecords const& records, Places const& place)
{
    Quad row[4] = {static_cast<Quad>(records.xyz.x), static_cast<Quad>(records.xyz.y), static_cast<Quad>(records.xyz.z),
                   static_cast<Quad>(records.w)};
    transpose(row);
    store_record(row[0], place(0)); // in a loop, GCC 12 takes the records through memory
    store_record(row[1], place(1));
    store_record(row[2], place(2));
    store_record(row[3], place(3));
}

#endif

} // namespace lanes_detail
#endif

/// A sum of records that lie side by side. Two of them are one vector where the processor has such.
template <int quads> struct RecordSum {
    Quad sum[quads] = {};

    KOKKOS_FORCEINLINE_FUNCTION void add(Real factor, Real const* records)
    {
        for (int q = 0; q < quads; ++q) sum[q] += factor * load_record(records + 4 * q);
    }
    KOKKOS_FORCEINLINE_FUNCTION void add(Real factor, RecordSum const& other)
    {
        for (int q = 0; q < quads; ++q) sum[q] += factor * other.sum[q];
    }
    KOKKOS_FORCEINLINE_FUNCTION Real operator[](int n) const { return sum[n / 4][n % 4]; }
};
#if defined(ARENITE_TURNS_IN_REGISTERS) && defined(__AVX512F__)
template <> struct RecordSum<2> {
    lanes_detail::Octet sum = {};

    KOKKOS_FORCEINLINE_FUNCTION void add(Real factor, Real const* records)
    {
        lanes_detail::Octet both;
        std::memcpy(&both, records, sizeof both);
        sum += factor * both;
    }
    KOKKOS_FORCEINLINE_FUNCTION void add(Real factor, RecordSum const& other) { sum += factor * other.sum; }
    KOKKOS_FORCEINLINE_FUNCTION Real operator[](int n) const { return sum[n]; }
};
#endif

/// Record quad(n), a Quad, in lane n.
template <class Quads> KOKKOS_FORCEINLINE_FUNCTION LaneRecords turned(Quads const& quad)
{
#ifdef ARENITE_TURNS_IN_REGISTERS
    return lanes_detail::turn(quad);
#else
    Quad quads[lane_count];
    for (int n = 0; n < lane_count; ++n) quads[n] = quad(n);
    Lanes part[4];
    for (int k = 0; k < 4; ++k) part[k] = make_lanes([&](int n) { return quads[n][k]; });
    return {{part[0], part[1], part[2]}, part[3]};
#endif
}

/// Record `rows[n]` of four numbers each in lane n.
KOKKOS_FORCEINLINE_FUNCTION LaneRecords load_records(Real const* records, int const* rows)
{
    return turned([&](int n) { return load_record(records + 4 * static_cast<std::ptrdiff_t>(rows[n])); });
}

/// Record `rows[n]` less record `others[n]` in lane n, but for the last number, a + sign b: one turn in place of two.
KOKKOS_FORCEINLINE_FUNCTION LaneRecords load_differences(Real const* records, int const* rows, int const* others, Real sign)
{
    return turned([&](int n) {
        Quad const a = load_record(records + 4 * static_cast<std::ptrdiff_t>(rows[n])),
                   b = load_record(records + 4 * static_cast<std::ptrdiff_t>(others[n]));
        return a + Quad{-1, -1, -1, sign} * b; // exact products
    });
}

/// Lane n's record to place(n).
template <class Places> KOKKOS_FORCEINLINE_FUNCTION void store_records_at(LaneRecords const& records, Places const& place)
{
#ifdef ARENITE_TURNS_IN_REGISTERS
    lanes_detail::store(records, place);
#else
    for (int n = 0; n < lane_count; ++n)
        store_record(Quad{lane(records.xyz.x, n), lane(records.xyz.y, n), lane(records.xyz.z, n), lane(records.w, n)},
                     place(n));
#endif
}

/// Lane n's record to `to + n * stride`.
KOKKOS_FORCEINLINE_FUNCTION void store_records(LaneRecords const& records, Real* to, int stride)
{
    store_records_at(records, [&](int n) { return to + n * stride; });
}

/// Lane n's record to record `rows[n]`.
KOKKOS_FORCEINLINE_FUNCTION void store_records(LaneRecords const& records, Real* to, int const* rows)
{
    store_records_at(records, [&](int n) { return to + 4 * static_cast<std::ptrdiff_t>(rows[n]); });
}

} // namespace arenite
