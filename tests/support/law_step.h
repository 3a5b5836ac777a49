/* One explicit step of one point through law_update (kernels/laws). */
#ifndef CLEAVE_TESTS_LAW_STEP
#define CLEAVE_TESTS_LAW_STEP

#include "kernels/laws/law_update.h"

/* Maps the trial stress of one point back to the yield surface of the flow law `law`, in place, by one explicit step at
 * 300 K without an effect of the strain rate. stress: trial stress [Pa]; before: stress at the start of the step [Pa],
 * NULL: 0; both with the components of particles.stress. *a, *work: accumulated plastic strain [1] and plastic work
 * [J/m^3], updated. *zz: sigma_zz - nu (sigma_xx + sigma_yy) in plane strain [Pa], updated. Returns the increment of
 * plastic strain [1]; 0, with nothing changed, if the point does not yield. */
static inline real law_step(const struct law *law, enum space space, const real *before, real *stress, real *a,
                            real *work, real *zz)
{
    const int dim = space_dim(space), n = symmetric_tensor_component_count(dim);
    const real start = *a, nu = law->poisson;
    struct law_points p = {.active = lanes_mask_from_bits(8)};
    for (int c = 0; c < SYM_MAX; c++) p.s[c] = p.before[c] = p.back[c] = lanes_broadcast(0);
    for (int c = 0; c < n; c++) {
        p.s[law_place[dim][c]] = lanes_broadcast(stress[c]);
        if (before) p.before[law_place[dim][c]] = lanes_broadcast(before[c]);
    }
    if (space == SPACE_PLANE_STRAIN) p.s[2] = nu * (p.s[0] + p.s[1]) + *zz;
    if (space == SPACE_PLANE_STRAIN) p.before[2] = nu * (p.before[0] + p.before[1]) + *zz;
    p.volume = p.volume_before = lanes_broadcast(1), p.temperature = lanes_broadcast(300);
    p.a = lanes_broadcast(*a), p.work = lanes_broadcast(*work);
    const unsigned flowed = law_update(law, &p, space, LAW_EXPLICIT);
    if (!(flowed >> 3 & 1)) return 0;
    for (int c = 0; c < n; c++) stress[c] = p.s[law_place[dim][c]][3];
    if (space == SPACE_PLANE_STRAIN) *zz = p.s[2][3] - nu * (p.s[0][3] + p.s[1][3]);
    *a = p.a[3], *work = p.work[3];
    return *a - start;
}

#endif
