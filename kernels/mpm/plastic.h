/* floor 2: von Mises plasticity of material points with linear isotropic hardening, by return mapping (Simo & Hughes
 * 1998, chapters 1 to 3). With the equivalent stress q and the accumulated equivalent plastic strain a,
 *     f = q - (sigma_y + H a) <= 0,   d eps_p = da dq/dsigma,   da >= 0,   da f = 0
 * and implicit Euler: f = 0 and the flow direction hold at the end of the step. */
#ifndef CLEAVE_PLASTIC_H
#define CLEAVE_PLASTIC_H

#include "kernels/kernels.h"

/* Brings a trial stress [Pa] beyond the yield surface of `strain` = a back to it; returns the increment of a, 0 where the
 * step is elastic. Plane strain only: out_of_plane is sigma_zz - nu (sigma_xx + sigma_yy) [Pa], which elastic steps leave
 * as it is. Not inlined, so that elastic points carry none of it. */
KERNEL(real, plastic_return, (const struct elastic *m, real *stress, real strain, real *out_of_plane));

#endif
