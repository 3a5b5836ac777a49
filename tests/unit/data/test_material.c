/* Materials: elastic constants compared with uniaxial tension, wave speeds, bilinear curve; micro-moduli and critical
 * stretches compared with integrals over the horizon. */
#include <math.h>

#include "bonds/family.h"
#include "data/material.h"
#include "tests/support/near.h"

enum { SPACES = 4 };
static const enum space spaces[SPACES] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};

static struct material made(enum space space, real poisson)
{
    struct material m = {.young = 7.3e9,
                         .poisson = poisson,
                         .density = 2300,
                         .energy_release_rate = 37,
                         .yield_stress = 3.1e6,
                         .yield_tangent = 1.7e9};
    material_compute_derived_constants(&m, space);
    return m;
}

/* Checks the derived elastic constants against closed forms. Tension along x with free sides: E and nu in plane stress
 * and 3D, E/(1 - nu^2) and nu/(1 - nu) in plane strain; shear G = E/(2 (1 + nu)); waves from c11 and G; Rayleigh speed
 * for nu = 1/4 in 3D and plane strain: c_R^2/c_s^2 = 2 - 2/sqrt(3). */
static void elastic_constants(void **state)
{
    (void)state;
    const real nu = 0.25, E = 7.3e9, G = E / (2 * (1 + nu));
    for (int k = 0; k < SPACES; k++) {
        const struct material m = made(spaces[k], nu);
        const int dim = space_dim(spaces[k]);
        const bool strain = spaces[k] == SPACE_PLANE_STRAIN;
        const real young = strain ? E / (1 - nu * nu) : E, poisson = dim == 1 ? 0 : strain ? nu / (1 - nu) : nu;
        assert_close(m.c11 - (dim - 1) * m.c12 * poisson, young, 1e-12);
        assert_near(m.c12 - poisson * (m.c11 + (dim - 2) * m.c12), 0, dim > 1 ? 1e-12 * E : 0);
        assert_close(square(m.wave_speed) * 2300, m.c11, 1e-12);
        assert_close(m.bulk * dim, m.c11 + (dim - 1) * m.c12, 1e-12);
        if (dim == 1) continue;
        assert_close(m.shear, G, 1e-12);
        assert_close(square(m.shear_speed) * 2300, G, 1e-12);
        if (spaces[k] == SPACE_PLANE_STRESS) continue;
        assert_close(square(m.rayleigh_speed / m.shear_speed), 2 - 2 / sqrt(3), 1e-9);
    }
}

/* Checks the stress under uniaxial loading: slope E up to the yield stress, E_t beyond; the plastic modulus H is in
 * series with E. */
static void bilinear_curve(void **state)
{
    (void)state;
    const struct material m = made(SPACE_LINE, 0);
    const real yield = 3.1e6 / 7.3e9;
    assert_close(material_uniaxial_stress(&m, 0.6 * yield), 0.6 * 3.1e6, 1e-12);
    assert_close(material_uniaxial_stress(&m, yield), 3.1e6, 1e-12);
    assert_close(material_uniaxial_stress(&m, yield + 2e-4), 3.1e6 + 1.7e9 * 2e-4, 1e-12);
    assert_close(1 / m.yield_hardening + 1 / 7.3e9, 1 / 1.7e9, 1e-12);
}

/* ---- integrals over the horizon ---------------------------------------------------------------------------------- */

enum { PIECES = 400 };
#define HORIZON 0.031
static const real pi = 3.14159265358979323846;

/* Returns the volume of a spherical shell of radius r divided by its thickness [m^2]. section: cross-section in 1D
 * [m^2], thickness in 2D [m], not used in 3D. */
static real shell(int dim, real r, real section)
{
    return dim == 1 ? 2 * section : dim == 2 ? 2 * pi * r * section : 4 * pi * r * r;
}

/* Checks the micro-moduli of a continuum and of a discrete neighbourhood. The energy per volume of all bonds under
 * uniform expansion s, the integral of 1/2 c s^2 r/2 dV, must be that of the material, dim^2 K s^2/2 with its bulk
 * modulus K in dim dimensions. Tolerance 1e-4: sum of 400 shells. */
static void micro_modulus(void **state)
{
    (void)state;
    for (int k = 0; k < SPACES; k++) {
        const int dim = space_dim(spaces[k]);
        const real section = dim == 1 ? 4e-5 : 0.37, s = 1.3e-4;
        const struct material m = made(spaces[k], dim == 1 ? 0 : bond_based_poisson_ratio(spaces[k]));
        const real c = material_micro_modulus_of_continuum(&m, spaces[k], HORIZON, section);
        real energy = 0, sigma = 0;
        for (int p = 0; p < PIECES; p++) {
            const real r = (p + 0.5) * HORIZON / PIECES, dV = shell(dim, r, section) * HORIZON / PIECES;
            energy += 0.25 * c * s * s * r * dV, sigma += r * dV;
        }
        assert_close(energy, 0.5 * dim * dim * m.bulk * s * s, 1e-4);
        assert_close(material_micro_modulus_of_discrete_family(&m, spaces[k], sigma), c, 1e-4);
    }
}

/* Checks the critical stretch by quadrature: the energy of all bonds across a unit area at the critical stretch s is
 * G_c = integral of 1/2 c s^2 r (fraction of the shell of radius r beyond the area) dV dz over radii r and heights z <
 * r. Tolerance 1e-3: 400 pieces, and roots at the ends of acos. */
static void critical_stretch(void **state)
{
    (void)state;
    for (int k = 0; k < SPACES; k++) {
        const int dim = space_dim(spaces[k]);
        const real section = dim == 1 ? 4e-5 : 0.37;
        const struct material m = made(spaces[k], dim == 1 ? 0 : bond_based_poisson_ratio(spaces[k]));
        const real s = material_critical_stretch(&m, spaces[k], HORIZON, STRETCH_BOND);
        const real c = material_micro_modulus_of_continuum(&m, spaces[k], HORIZON, section);
        real energy = 0;
        for (int p = 0; p < PIECES; p++)
            for (int q = 0; q < PIECES; q++) {
                const real r = (p + 0.5) * HORIZON / PIECES, z = (q + 0.5) * r / PIECES;
                const real beyond = dim == 1 ? 0.5 : dim == 2 ? acos(z / r) / pi : 0.5 * (1 - z / r);
                energy += 0.5 * c * s * s * r * beyond * shell(dim, r, section) * HORIZON / PIECES * r / PIECES;
            }
        assert_close(energy, 37, 1e-3); /* tolerance: roots at the ends of acos, 400 pieces */
    }
}

/* Checks the critical stretch of the ordinary state-based model against the examples of Madenci & Oterkus 2014,
 * sections 6.2 and 6.3. */
static void critical_stretch_of_states(void **state)
{
    (void)state;
    const struct material plate = made(SPACE_PLANE_STRESS, 0.21), solid = made(SPACE_SOLID, 0.21);
    const real G = 7.3e9 / 2.42, k2 = 7.3e9 / (2 * (1 - 0.21)), K = 7.3e9 / (3 * (1 - 0.42));
    assert_close(material_critical_stretch(&plate, SPACE_PLANE_STRESS, HORIZON, STRETCH_OSPD),
                 sqrt(37 / ((1.909859317 * G + 0.1801265486 * (k2 - 2 * G)) * HORIZON)), 1e-8);
    assert_close(material_critical_stretch(&solid, SPACE_SOLID, HORIZON, STRETCH_OSPD),
                 sqrt(37 / ((3 * G + 0.31640625 * (K - 5 * G / 3)) * HORIZON)), 1e-8);
}

/* Checks the weight of each influence function at one distance, and the horizon of the volume-modified calibration, a
 * half-integer number of spacings. */
static void families(void **state)
{
    (void)state;
    const real h = 1.3e-3, delta = 3.015 * h, xi[] = {2 * h, h, 0}, r = sqrt(5) * h;
    const real wanted[] = {1, exp(-5 / square(3.015)), 3.015 / sqrt(5), square(3.015) / 5, 1 - sqrt(5) / 4.015};
    for (int k = INFLUENCE_ONE; k <= INFLUENCE_LINEAR; k++) {
        struct family f = {.influence = (enum influence)k};
        family_make_on_lattice(&f, SPACE_PLANE_STRESS, h, 3.015, 0.37);
        assert_close(f.horizon, delta, 1e-12);
        assert_close(f.cell_volume, h * h * 0.37, 1e-12);
        assert_close(family_bond_weight(&f, xi, r), wanted[k], 1e-9);
    }
    struct family f = {.calibration = CALIBRATION_VMPD};
    family_make_on_lattice(&f, SPACE_LINE, h, 3, 4e-5);
    assert_close(f.horizon, 3.5 * h, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_constants),
        cmocka_unit_test(bilinear_curve),
        cmocka_unit_test(micro_modulus),
        cmocka_unit_test(critical_stretch),
        cmocka_unit_test(critical_stretch_of_states),
        cmocka_unit_test(families),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
