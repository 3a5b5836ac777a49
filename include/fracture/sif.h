/* Stress-intensity factors by the interaction integral, on particles of either kind.
 *
 * The flux of energy (W + T) n_1 - sigma_ij n_j u_i,1 into a moving tip (Freund 1990, eq. 5.2.7), of the actual and
 * an auxiliary motion together, as an integral over a disc round the tip (Nakamura, Shih & Freund 1985):
 *
 *   I = sum q_,j [sigma_ij u^a_i,1 + sigma^a_ij u_i,1 - (sigma_ml u^a_m,l + rho v_l v^a_l) delta_1j] A
 *     + sum q [rho (a_i u^a_i,1 + a^a_i u_i,1) - rho (v_i v^a_i,1 + v^a_i v_i,1)] A
 *
 * with the weight q = 1 for r < inner, 0 for r > outer. sigma_ij,j is replaced by rho times a, the acceleration less
 * what loads give to the particle (gravity, body forces, pressure on faces of the crack), so that no stress is
 * differentiated. K = E* I/(2 A(v)) for an auxiliary field of K^a = 1; J = I(actual, actual)/2. At rest, without
 * inertia and such loads, only the ring where q varies contributes. */
#ifndef CLEAVE_SIF
#define CLEAVE_SIF

#include "bonds/bonds.h"
#include "data/cells.h"
#include "data/particles.h"
#include "scene/requests.h"
#include "sif_fields.h"

/* ---- gradients at particles (sif_gradient.c) --------------------------------------------------------------------- */

/* What makes particles invisible to each other: cracks that cut the line between their reference positions, and bonds
 * that load has broken. */
struct sight {
    const struct crack *crack;
    int cracks;
    const struct bonds *bonds; /* NULL: without */
};

struct gradient_rule {
    enum gradient_method method;
    real reach; /* rho_m; neighbours within twice as much [m] */
    struct sight sight;
    int diffraction;   /* l of Organ et al. 1996, 1 or 2: hidden neighbours count as farther,
                          round the tip; 0: not at all (visibility) */
    real tip[DIM_MAX]; /*                                                     [m] */
};

/* df/dX_d at a particle: sum of weight[k][d] (f(particle[k]) - f at the particle itself). */
struct gradient_stencil {
    int n, room;
    int32_t *particle;
    real (*weight)[2]; /* [1/m] */
    int order;         /* of the polynomials it is exact for; 0: too few neighbours, no weights */
};

void gradient_stencil_at(struct gradient_stencil *s, const struct gradient_rule *rule, const struct particles *p,
                         const struct cells *c, int64_t i);
void gradient_stencil_free(struct gradient_stencil *s);
/* gradient[a][b] = d field_a/dX_b at particle i; field[0], field[1] are by particle, images included. */
void gradient_of(const struct gradient_stencil *s, int64_t i, const real *const field[2], real gradient[2][2]);

/* ---- the integral (sif.c) ---------------------------------------------------------------------------------------- */

struct contour {
    real inner, outer;
}; /* where q leaves 1 and reaches 0 [m] */

/* A tip and how to integrate round it. */
struct sif_tip {
    struct crack_medium medium;
    real place[2], along[2]; /* reference position [m]; unit vector ahead */
    int face;                /* +-1: side of x_2 to which particles on the crack belong */
    int body;                /* whose particles count; -1: all */
    real speed;              /* v; 0: at rest [m/s] */
    real core;               /* where the second sum counts by half while the tip moves: not at all within a
                                third of it, whole from five thirds on [m] */
    real thickness;          /*                                                       [m] */
    enum sif_weight weight;
    enum sif_stress stress;
};

/* The motion at one time, by particle (images included); velocity and acceleration NULL: in equilibrium. */
struct sif_motion {
    const real *displacement[2], *velocity[2], *acceleration[2]; /* [m] [m/s] [m/s^2] */
    const real *body[2];   /* forces of loads over masses; NULL: there are none within contours [m/s^2] */
    const real *stress[3]; /* xx yy xy, only SIF_PARTICLE [Pa] */
};

struct sif {
    real K[MODES], J;
}; /* [Pa m^(1/2)], [J/m^2] */

/* Weight and its slope at distance r. */
void sif_weight(enum sif_weight form, const struct contour *c, real r, real *q, real *slope);

/* What a point at x (local frame) adds to I, over its area [N/m / m^2]; the share `inside` of the second sum. The sums
 * above are symmetric in the two motions but for sigma u^a. */
real sif_density(const struct sif_tip *tip, const struct contour *c, const real x[2], const struct crack_state *actual,
                 const struct crack_state *auxiliary, real inside);

/* Factors for each of n contours: one pass over the particles for their gradients. */
void sif_integrate(const struct sif_tip *tip, const struct contour *contour, int n, const struct sif_motion *motion,
                   const struct gradient_rule *rule, const struct particles *p, const struct cells *c,
                   struct sif *found);

/* Largest difference between contours: of K_I or K_II over |K|, or of J over J, means over the contours in the
 * denominators; NAN where they are 0. */
real sif_spread(const struct sif *found, int n);

#endif
