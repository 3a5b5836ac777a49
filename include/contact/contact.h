/* Room `contact`: forces between peridynamic particles that no bond joins: faces of cracks, fragments, bodies. It
 * knows particles, cells, bonds and loads, but neither scenes nor the step; the engine calls it.
 *
 * Law: a pair without an intact bond, closer than its contact distance d, is pushed apart by k (d - r) along the line
 * of centres; k = 15 c V_i V_j/delta, the usual short-range stiffness of peridynamics, for delta = 3.015 spacings
 * whatever the horizon of the scene, so that contact is as stiff as a cell of the material. Its energy is
 * 1/2 k (d - r)^2.
 *
 *     d = least of the reference distance of the two and the mean of their spacings
 *
 * so that bodies and faces touch at their true surfaces: nothing overlaps in the reference state, and a bond that is
 * torn apart leaves a pair that is farther apart than d. A pair that is met closer than d (its bond ended under
 * pressure) starts with d = r, which follows the pair up to d as it opens: no energy appears.
 *
 * Only particles near a face can meet: those of the first layer of a body, and those that have lost a bond. */
#ifndef CLEAVE_CONTACT
#define CLEAVE_CONTACT

#include "active/active_rows.h"
#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"

enum contact_between { CONTACT_NONE, CONTACT_BODIES, CONTACT_ALL };

struct contact_law {
    enum contact_between between;        /* which particles may meet: none, those of two bodies, all */
    int materials;
    real *stiffness;                     /* [materials^2] k/(V_i V_j) [N/m^7] */
    real spacing, section;               /* of the lattice [m]; as in lattice_volume */
    const struct image *image;           /* of loads */
};

/* Pairs near enough to meet before the next search, row by row: each pair stands in the rows of both its particles, so
 * that each row has one owner. */
struct contact {
    struct contact_law law;
    bool made;                           /* a search has been made */
    int64_t n, rows;                     /* particles that may meet, images included; of the body, which come first */
    int32_t *particle;                   /* [n] ascending */
    real *at[DIM_MAX];                   /* [n] where they were at the last search [m] */
    int64_t *first;                      /* [rows + 1] */
    int64_t pairs;
    int32_t *other;                      /* [pairs] ascending within a row */
    real *distance;                      /* [pairs] d [m] */
    int64_t searched, broken, peridynamic; /* at the last search: step; directed bonds broken; peridynamic particles */
    int64_t pairs_most;                  /* pairs in contact at once, most so far */
    real overlap;                        /* largest (d - r) of the last step that looked [m] */
    real overlap_most;                   /* of all [m] */
    int32_t deepest;                     /* a particle of the pair with the largest overlap, -1: none */
    bool overlap_said;                   /* a warning of large overlaps has been given */
    int64_t touching;                    /* directed pairs in contact in the last step */
};

/* Law for the materials of the bonds. stiffness: factor on k [1]. */
void contact_make(struct contact *c, enum contact_between between, real stiffness, const struct bond_source *source);
void contact_free(struct contact *c);

/* Critical step of particles that contact pushes on one side and bonds hold on the other [s]; `bonds`: of bonds [s]. */
real contact_critical_step(const struct contact *c, const struct particles *p, const struct material *m, real bonds);

/* Before a step: searches anew if particles have come too far since the last search, if bonds have broken a while ago,
 * or if particles have changed their kind; what a pair can push counts as loaded and its row blocks are active.
 * broken: directed bonds broken so far. */
void contact_update(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l,
                    const struct family *family, int64_t step, int64_t broken);
/* Marks the particles of pairs as loaded and their row blocks as active; also after a restart. */
void contact_follow(const struct contact *c, const struct particles *p, struct bonds *b, struct loads *l);

/* Adds the forces to part.f, and finds the largest overlap. After the forces of bonds, before loads. */
void contact_force(struct contact *c, struct particles *p);

/* Energy of all pairs where they are now [J]; half of that of pairs with an image. */
real contact_energy(const struct contact *c, const struct particles *p);

status contact_archive(struct contact *c, const struct particles *p, struct archive *a);

#endif
