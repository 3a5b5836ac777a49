/* Stress-intensity factors by the interaction integral over particles of any kind.
 *
 * The energy flux (W + T) n_1 - sigma_ij n_j u_i,1 into a moving tip (Freund 1990, eq. 5.2.7), of the actual
 * and an auxiliary motion together, is computed as a sum over the particles of a disc round the tip
 * (Nakamura, Shih & Freund 1985):
 *
 * I = sum q_,j [sigma_ij u^a_i,1 + sigma^a_ij u_i,1 - (sigma_ml u^a_m,l + rho v_l v^a_l) delta_1j] A
 *     + sum q [rho (a_i u^a_i,1 + a^a_i u_i,1) - rho (v_i v^a_i,1 + v^a_i v_i,1)] A
 *
 * with the stress sigma, the displacement u, the velocity v, the acceleration a, the density rho and the area
 * A of a particle; superscript a: auxiliary motion; W, T: densities of strain and kinetic energy. The weight
 * is q = 1 for r < inner and 0 for r > outer. sigma_ij,j is replaced by rho times the acceleration minus that
 * by loads on the particle (gravity, body forces, pressure on the faces of the crack), so that no stress is
 * differentiated. K = E* I/(2 A(v)) for an auxiliary field of K^a = 1, with the universal function A(v) of
 * sif_fields.h; J = I(actual, actual)/2. At rest, without inertia and such loads, only the ring where q
 * varies contributes. */
#ifndef CLEAVE_SIF
#define CLEAVE_SIF

#include "bonds/bonds.h"
#include "data/cells.h"
#include "data/particles.h"
#include "scene/requests.h"
#include "sif_fields.h"

/* ---- gradients at particles (sif_gradient.c) --------------------------------------------------------------------- */

/* Cracks and bonds that determine which neighbours of a particle count for gradients: a neighbour is hidden, and does
 * not count, if one of crack[cracks] cuts the line between the two reference positions, or if load has broken the bond
 * between the two particles. */
struct sight {
    const struct crack *crack;
    int cracks;
    const struct bonds *bonds; /* bonds; neighbours behind a broken one are hidden; NULL: none are */
};

/* How gradients of fields at particles are computed: method, range, and which neighbours count (`sight`: cracks and
 * broken bonds that hide neighbours). */
struct gradient_rule {
    enum gradient_method method;
    real reach; /* rho_m; range of neighbours is 2 rho_m [m] */
    struct sight sight;
    /* exponent of the diffraction method of Organ et al. 1996, 1 or 2: hidden neighbours have the distance round the
     * tip; 0: hidden neighbours are left out (visibility method) */
    int diffraction;
    real tip[DIM_MAX]; /* position of the tip [m] */
};

/* Weights by which the gradient of a field f at particle i follows from values at its neighbours: df/dX_d = sum_k
 * weight[k][d] (f(particle[k]) - f(i)) over the n neighbours particle[k], for the plane components d = 0, 1. room:
 * capacity of the arrays. */
struct gradient_stencil {
    int n, room;
    int32_t *particle;
    real (*weight)[2]; /* [1/m] */
    /* order of the polynomials for which the gradient is exact; 0: too few neighbours, no weights */
    int order;
};

/* Computes the weights by which values at neighbours give the gradient of a field at the particle with index `particle`
 * of p, and stores them in *s. *s must be 0 or filled by an earlier call, whose arrays are reused. rule: method of the
 * gradient, range and visibility of neighbours; c: neighbour search over the reference positions. If too few neighbours
 * of the particle are visible, s->order is 0 and there are no weights. Release with gradient_stencil_free. */
void gradient_stencil_compute_weights(struct gradient_stencil *s, const struct gradient_rule *rule,
                                      const struct particles *p, const struct cells *c, int64_t particle);

/* Frees the arrays of the gradient stencil s. */
void gradient_stencil_free(struct gradient_stencil *s);

/* Computes the gradient of a plane vector field at the particle with index `particle`: gradient[a][b] = d field_a/dX_b.
 * s: stencil of this particle (gradient_stencil_compute_weights); field[a]: component a for every particle, mirror
 * images included. */
void gradient_stencil_apply(const struct gradient_stencil *s, int64_t particle, const real *const field[2],
                            real gradient[2][2]);

/* ---- the integral (sif.c) ---------------------------------------------------------------------------------------- */

/* An annulus round a crack tip, over which the weight q of the interaction integral decreases. inner, outer: radii at
 * which q begins to decrease from 1 and reaches 0 [m]. */
struct contour {
    real inner, outer;
};

/* A crack tip in an elastic medium and options of the interaction integral round the tip. The integral is the sum of a
 * stress part and an inertia part. */
struct sif_tip {
    struct crack_medium medium;
    real place[2], along[2]; /* reference position [m]; unit vector of the direction of growth */
    int face;                /* +-1: side of the crack (sign of x_2) to which particles on it belong */
    int body;                /* particles of this body contribute; -1: of all bodies */
    real speed;              /* speed v of the tip, 0: at rest [m/s] */
    /* radius at which the inertia part has the weight 1/2 while the tip moves; the weight is 0 within a third of this
     * radius and 1 beyond five thirds of it [m] */
    real core;
    real thickness;         /* thickness of the body [m] */
    enum sif_weight weight; /* weight function of the integral */
    enum sif_stress stress; /* source of the stress */
};

/* Motion of all particles, mirror images included, at one time, as arrays [component 0, 1][particle] in the plane.
 * velocity and acceleration are NULL for an equilibrium. */
struct sif_motion {
    const real *displacement[2], *velocity[2], *acceleration[2]; /* [m] [m/s] [m/s^2] */
    const real *body[2];   /* forces of loads divided by masses [m/s^2]; NULL: no loads inside the contours */
    const real *stress[3]; /* xx, yy, xy [Pa]; SIF_PARTICLE only */
};

/* Stress-intensity factors K[MODE_I], K[MODE_II] [Pa m^(1/2)] and J [J/m^2] of a crack tip. */
struct sif {
    real K[MODES], J;
};

/* Computes the weight q of the interaction integral and the slope of q at the distance r = `distance` [m] from the
 * crack tip. *weight receives q, 1 for r <= contour->inner and 0 for r >= contour->outer; *slope receives dq/dr [1/m].
 * form: function by which q decreases between the two radii. */
void sif_contour_weight_and_slope(enum sif_weight form, const struct contour *contour, real distance, real *weight,
                                  real *slope);

/* Returns the integrand [N/m^3] of the interaction integral I at a point, i.e. the contribution of the point divided by
 * its area. tip: crack tip and elastic constants; x: position of the point in the frame of the crack tip, x[0] ahead of
 * the tip [m]; contour: radii where the weight q decreases from 1 and reaches 0; actual, auxiliary: the two motions at
 * the point, in the same frame; inertia_factor: factor, 0 to 1, on the part of I with the inertia terms. */
real sif_interaction_integrand(const struct sif_tip *tip, const struct contour *contour, const real x[2],
                               const struct crack_state *actual, const struct crack_state *auxiliary,
                               real inertia_factor);

/* Computes the stress-intensity factors and J of the crack tip `tip` by the interaction integral. contour:
 * `contour_count` pairs of radii, integrated in one pass over the particles p. motion: displacement, velocity,
 * acceleration and loads of all particles; rule: how gradients are computed; c: neighbour search over the reference
 * positions. result: receives for each contour K_I and K_II [Pa m^(1/2)] and J [J/m^2]. */
void sif_compute_by_interaction_integral(const struct sif_tip *tip, const struct contour *contour, int contour_count,
                                         const struct sif_motion *motion, const struct gradient_rule *rule,
                                         const struct particles *p, const struct cells *c, struct sif *result);

/* Returns the relative spread of the stress-intensity factors result[contour_count], each computed with another contour
 * (annulus round the crack tip): the largest minus the smallest K_I, or K_II, divided by sqrt(K_I^2 + K_II^2) of the
 * mean factors, or the largest minus the smallest J divided by the mean J, whichever is largest. The spread measures
 * how far the result depends on the radii. Returns NAN if a divisor is 0. */
real sif_relative_spread_over_contours(const struct sif *result, int contour_count);

#endif
