/* Von Mises plasticity of material points with linear isotropic hardening, by return mapping (Simo & Hughes
 * 1998, chapters 1 to 3). With the equivalent stress q and the accumulated equivalent plastic strain a,
 *     f = q - (sigma_y + H a) <= 0,   d eps_p = da dq/dsigma,   da >= 0,   da f = 0
 * and implicit Euler: f = 0 and the flow direction hold at the end of the step. */
#ifndef CLEAVE_KERNELS_PLASTIC
#define CLEAVE_KERNELS_PLASTIC

#include "kernels/kernels.h"

/* Maps a trial stress [Pa] beyond the yield surface, at the accumulated plastic strain a = `strain`, back to that
 * surface, in place. Returns the increment of a [1], 0 for an elastic step. out_of_plane, in plane strain only:
 * sigma_zz - nu (sigma_xx + sigma_yy) [Pa], unchanged in elastic steps. Not inlined, so that the code for elastic
 * points contains none of it. */
KERNEL(real, plastic_return, (const struct elastic *m, real *stress, real strain, real *out_of_plane));

#endif
