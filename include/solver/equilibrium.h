/* Equilibrium of any set of forces that have an energy, by Newton's method: each correction by preconditioned conjugate
 * gradients (Hestenes & Stiefel 1952), cut off where it is exact enough (Dembo, Eisenstat & Steihaug 1982). There is no
 * matrix: the stiffness along a direction is a difference of forces (Knoll & Keyes 2004).
 *
 * Unknowns are displacements of nodes: particles, or nodes of a mesh. What they are is known to the caller alone. */
#ifndef CLEAVE_EQUILIBRIUM
#define CLEAVE_EQUILIBRIUM

#include "base/base.h"
#include "solver/field.h"

struct equilibrium {
    int dim;
    int64_t n;                      /* nodes */
    struct field u, f;              /* [n] displacement [m]; force there [N]. Of held components: on the support */
    uint8_t *held;                  /* [n] bit d: component d is prescribed */
    struct field d, q, r, z, x, at; /* [n] of conjugate gradients; displacement where forces are asked for [m] */
    struct field before, grown;     /* [n] forces at u of the loads that acted there before; their growth [N] */

    /* Forces at u, into f: all but those of supports. Twice at one u they are the same. */
    void (*force)(void *context, const struct field *u, struct field *f);
    /* z = M^-1 r, M symmetric and positive definite; held components of z are 0. */
    void (*precondition)(void *context, const struct field *r, struct field *z);
    /* Laws of forces that are smooth between two settles, as conjugate gradients ask for. Settle: they become those of
     * where the body is now; true: they were. It may set `applied` anew. Laws: for the length of a correction forces
     * are by the laws of wherever they are asked for; settled: again by those of the last settle. NULL: laws are the
     * same everywhere. */
    bool (*settle)(void *context);
    void (*laws)(void *context, bool settled);
    void *context;

    real tolerance;   /* of the residual: its norm over that of loads or reactions [1] */
    real reach;       /* longest way of a node in a correction [m]; 0: any */
    real noise;       /* norm of forces below which nothing is resolved [N] */
    real length;      /* between neighbours [m] */
    real unit_energy; /* of the body at unit strain [J], which sets the steps of differences */
    bool kinked;      /* forces change their slope suddenly, as where points yield */

    /* Since equilibrium_make or the caller has set them to 0: */
    int64_t forces, directions; /* evaluations of all forces; directions of conjugate gradients */
    real lost;                  /* work of forces that were not in balance, on the way to balance, where that
                                 * of supports is the mean of their forces in both equilibria times their way,
                                 * not that on the way [J] */

    real bent;         /* work of loads on the last way beyond the mean of both ends times it [J] */
    real residual;     /* what is left, over `scale` [1] */
    real scale;        /* larger one of the norms of applied forces and reactions [N] */
    real largest;      /* the largest of these so far [N] */
    real applied;      /* norm of the applied forces, set by the caller [N] */
    real strain_ratio; /* strain of the last direction over its largest component [1/m] */
    int64_t worst;     /* node with the largest residual */
};

void equilibrium_make(struct equilibrium *q, int dim, int64_t n);
void equilibrium_free(struct equilibrium *q);

/* From u with the forces f that act there, to equilibrium under the forces that now act: `way` [n] is added to u first.
 * Its held components are where supports go; the others are a guess. `moved`: loads or supports have; f are the forces
 * of the old ones, else something has given way since. FAILED where no equilibrium is in reach; u is then the nearest
 * that was found. */
status equilibrium_find(struct equilibrium *q, const struct field *way, bool moved);

#endif
