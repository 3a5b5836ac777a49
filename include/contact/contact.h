/* Room `contact`: forces between peridynamic particles that no bond joins: faces of cracks, fragments, bodies. It
 * knows particles, cells, bonds and loads, but neither scenes nor the step; the engine calls it.
 *
 * Two forms of the law. Both push faces apart by k times the overlap, k = 15 c V_i V_j/delta a particle of the face:
 * the usual short-range stiffness of peridynamics, for delta = 3.015 spacings whatever the horizon of the scene, so
 * that contact is as stiff as a cell of the material. Both are gradients of an energy, 1/2 k overlap^2.
 *
 *     surface  each particle feels where the smooth face beside it lies (contact_face.c); contact begins one spacing
 *              above its first layer
 *     pair     each pair of particles closer than d is pushed apart along its line of centres (contact_pair.c); d: one
 *              spacing. Faces that slide mesh like gears
 *
 * so that bodies and faces touch at their true surfaces. Contact begins later for what the reference state has closer,
 * and for what is met closer (bonds that ended under pressure), until it opens: nothing overlaps in the reference state
 * or at the moment of cutting, and no energy appears.
 *
 * Only particles near a face can meet: those of the first layer of a body, and those that have lost a bond. */
#ifndef CLEAVE_CONTACT
#define CLEAVE_CONTACT

#include "loads/active_rows.h"
#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"
#include "rigid/rigid.h"
#include "scene/requests.h"

/* Depth of a face below a particle, in spacings, by the density that it feels there (contact_face.c). */
enum { PROFILE_NODES = 86 };
struct contact_profile {
    real density[PROFILE_NODES], depth[PROFILE_NODES], slope[PROFILE_NODES];
};

struct contact_law {
    enum contact_between between;   /* which particles may meet: none, those of two bodies, all */
    enum contact_form form;         /* faces, or pairs of particles */
    enum contact_distance distance; /* of pairs */
    struct contact_profile profile; /* of faces */
    real friction;                  /* coefficient [1] */
    int materials;
    real *stiffness;           /* [materials^2] k/(V_i V_j) [N/m^7] */
    real spacing, section;     /* of the lattice [m]; as in lattice_volume */
    const struct image *image; /* of loads */
    const struct crack *crack; /* borrowed; those with a width are notches */
    int cracks;
    const struct region *const *shape; /* [bodies] borrowed, NULL: a list of particles */
};

/* Friction of a particle that touches something: a spring along the face, laid down by its motion there. */
struct contact_spring {
    real length[DIM_MAX]; /* [m] */
    real drag[DIM_MAX];   /* its force on the particle [N] */
    real density;         /* of the face it feels, over which the reaction is spread */
    real stored, lost;    /* energy it holds; friction's work since the last search [J] */
};

/* How the particles that one feels carry the drag of its spring (contact_friction.c): by their weights, with a couple
 * that balances its moment. Computed anew from the spring in every step. */
struct contact_reaction {
    real arm[DIM_MAX];  /* from their weighted mean position to the particle [m] */
    real turn[DIM_MAX]; /* moment of the drag about it over their moment of inertia [N/m] */
};

/* What a particle feels of faces beside it: energy 1/4 k g^2 where the gap g < 0 (contact_face.c). */
struct contact_face {
    real zero;             /* height of its own surface, where contact begins [spacings] */
    real stiffness;        /* k [J] */
    real far;              /* least gap at the search, 0 or more [spacings] */
    real push, lift, mean; /* derivative of its energy by the density; by the mean rise, over the density
                              [J]; mean rise [spacings] */
};

/* Account of what the time step gives and takes at the ends of contact (contact_balance.c). */
struct contact_balance {
    real gap, older; /* of the last two steps [spacings] */
    real drag;       /* force against the rate of the gap [J] */
    real account;    /* energy given less taken [J] */
};

/* Particles near a rigid body: rows, ascending, and the gap at which contact begins, 0 or less [m]; where the body was
 * at the search. */
struct contact_near {
    int64_t n;
    int32_t *row;
    real *zero, x[DIM_MAX], turn[DIM_MAX * DIM_MAX];
    struct contact_spring *spring;
    struct contact_balance *balance;
    uint8_t *touch;
};

/* A contact that pushes: the rate of its gap is the sum of along . v of its particles; energy 1/2 stiffness gap^2. */
struct contact_term {
    int n;
    int32_t *particle;      /* [n] images included */
    real (*along)[DIM_MAX]; /* [n] derivative of the gap [1], of faces [1/m] */
    real stiffness;         /* [N/m], of faces [J] */
};

/* Pairs near enough to meet before the next search, row by row: each pair stands in the rows of both its particles, so
 * that each row has one owner. */
struct contact {
    struct contact_law law;
    bool made;         /* a search has been made */
    int64_t n, rows;   /* particles that may meet, images included; of the body, which come first */
    int32_t *particle; /* [n] ascending */
    int32_t *root;     /* [n] row of the particle of which it is an image, its own if of none */
    real *size;        /* [n] spacing of the particle [m] */
    real *rise;        /* [n] of the surface of its body above it, beyond 1/2 [spacings] */
    real *at[DIM_MAX]; /* [n] where they were at the last search [m] */
    int64_t *first;    /* [rows + 1] */
    int64_t pairs;
    int32_t *other;                    /* [pairs] places in `particle`, ascending within a row */
    real *distance;                    /* pairs: [pairs] d [m] */
    struct contact_face *face;         /* faces: [rows] */
    struct contact_balance *balance;   /* faces: [rows] */
    struct contact_spring *spring;     /* [rows], with friction */
    struct contact_reaction *reaction; /* [rows], with friction */
    uint8_t *followed;                 /* [rows] what may push it: a row_state of contact_internal.h */
    bool marked;                       /* in equilibria: what is marked pushes, or pulls, and nothing else does */
    uint8_t *touch;                    /* marks, of faces [rows], of pairs [pairs]; NULL: none yet */
    bool by_overlap;                   /* marks are there, and do not count for now */
    int64_t waiting;                   /* rows that may feel something once it has moved */
    real friction_work;                /* up to the last search [J] */
    int rigids;
    struct rigid_body *rigid;  /* borrowed */
    struct contact_near *near; /* [rigids]; NULL before the first search */
    real way;                  /* the farthest that a particle has come since the search [m] */
    int64_t searched, broken;  /* at the last search: step; directed bonds broken */
    int64_t changed;           /* changes of kind that the marks of rows know */
    bool due;                  /* a search is due, whatever has moved */
    int64_t pairs_most;        /* pairs in contact at once, most so far */
    real overlap;              /* largest (d - r) of the last step that looked [m] */
    real overlap_most;         /* of all [m] */
    int32_t deepest;           /* a particle of the pair with the largest overlap, -1: none */
    bool overlap_said;         /* a warning of large overlaps has been given */
    real began, ended;         /* of all contact so far, NAN: none yet [s] */
    int64_t touching;          /* directed pairs in contact in the last step */
    bool recorded;             /* the next step's forces are recorded in ... */
    real *push[DIM_MAX];       /* ... [particles of the body] NULL until then [N] */
};

/* Law for the materials of the bonds, of which form, distance and friction are given; stiffness: factor on k [1].
 * shape: [bodies]; those and rigid bodies are borrowed. */
void contact_make(struct contact *c, enum contact_between between, struct contact_law law, real stiffness,
                  const struct bond_source *source, const struct region *const *shape, struct rigid_body *rigid,
                  int rigids);
void contact_free(struct contact *c);

/* Critical step of particles that contact pushes on one side and bonds hold on the other [s]; `bonds`: of bonds [s]. */
real contact_critical_step(const struct contact *c, const struct particles *p, const struct material *m, real bonds);

/* Before a step: searches anew if particles have come too far since the last search, if bonds have broken a while ago,
 * or if one is due; what a pair can push counts as loaded and its row blocks are active. broken: directed bonds broken
 * so far; changed: changes of kind so far. */
void contact_update(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l,
                    const struct family *family, int64_t step, int64_t broken, int64_t changed);
/* These have become peridynamic: a search is due if one of them is at a face. */
void contact_add(struct contact *c, const struct bonds *b, const struct family *family, const int32_t *list, int64_t n);
/* Marks the particles that something may push as loaded and their row blocks as active; also after a restart. */
void contact_follow(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l);

/* Adds the forces to part.f and to rigid bodies, and finds the largest overlap. After the forces of bonds, before
 * loads. dt: for which particles have moved with their velocities since the last call [s]. */
void contact_force(struct contact *c, struct particles *p, real dt);
/* Makes room for `push`, if anything can meet: forces are recorded where c->recorded is set. */
void contact_record(struct contact *c, const struct particles *p);
/* Notes that the time is t [s]. */
void contact_clock(struct contact *c, real t);

/* Energy of all pairs where they are now [J]; half of that of pairs with an image. */
real contact_energy(const struct contact *c, const struct particles *p);
/* Width of what touches rigid body `body`: diagonal of the box round the particles that it pushes [m]; 0: none. */
real contact_patch(const struct contact *c, const struct particles *p, int body);
/* Work that friction has taken so far [J]. */
real contact_friction_work(const struct contact *c);

/* Equilibria (contact_touch.c). Under the laws of marks forces are smooth, and an equilibrium is one of contact if what
 * overlaps there is what is marked. contact_search: pairs anew, as contact_update finds them; then all that overlaps is
 * marked, and what is closer than `close` to another body [spacings]. contact_mark: the same without a search, which
 * leaves alone what is within round-off. Both return how many marks have changed; nothing dashes (contact_balance). */
int64_t contact_search(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l,
                       const struct family *family, real close);
int64_t contact_mark(struct contact *c, const struct particles *p, real close);
/* Do marks count, or overlaps? */
void contact_marks_use(struct contact *c, bool use);
/* The law by overlaps again: marks are gone, and a search is due. */
void contact_unmark(struct contact *c);
/* Have particles, or rigid bodies, come too far since the search? */
bool contact_has_come(struct contact *c, const struct particles *p);
/* Longest way of a particle at which contact still sees all [m]. */
real contact_sight(const struct contact *c);
/* Visits all that is marked, row by row. */
void contact_terms(const struct contact *c, const struct particles *p,
                   void (*visit)(void *context, const struct contact_term *term), void *context);
/* Norm of the forces of rigid bodies on particles [N]. */
real contact_rigid_norm(const struct contact *c, const struct particles *p);

status contact_archive(struct contact *c, const struct particles *p, struct archive *a);

#endif
