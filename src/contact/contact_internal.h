/* Inside `contact`: the two forms of the law share the list of pairs. */
#ifndef CLEAVE_CONTACT_INTERNAL
#define CLEAVE_CONTACT_INTERNAL

#include "contact/contact.h"

#define CONTACT_REACH 2.0 /* of the field of a face [mean spacings] */
#define CONTACT_SKIN 0.3  /* beyond the contact distance [spacings]: pairs that may come to it soon */
#define STATIC_SKIN 1.5   /* the same for the corrections of an equilibrium [spacings] */
#define FAR_LAMMPS 1.35   /* distance of pairs in LAMMPS' rule at the most [mean spacings] and ... */
#define NEAR_LAMMPS 0.9   /* ... [their distance in the reference state] */
#define CONTACT_FLATNESS                                                                                               \
    3 /* a gap shrinks by this times the way of a particle: of both sides, and more                                    \
         where fields are not flat */

/* What may push a row before the next search: nothing; something once it has moved; what feels it; what it feels. */
enum row_state { ROW_FAR, ROW_NEAR, ROW_FELT, ROW_FEELS };

/* What the rows of a step have found. */
struct contact_found {
    real overlap;
    int64_t touching;
    int32_t deepest;
};

static inline void contact_found_add(struct contact_found *to, real overlap, int32_t i)
{
    const bool first = overlap == to->overlap && i < to->deepest;
    if (overlap > to->overlap || first) to->overlap = overlap, to->deepest = i;
    to->touching++;
}

/* Vector from entry l of the list to entry k, and its square [m^2]. */
static inline real contact_apart(const struct contact *c, const struct particles *p, int64_t k, int64_t l, real *apart)
{
    const int32_t i = c->particle[k], j = c->particle[l];
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) {
        apart[d] = p->x[d][i] - p->x[d][j];
        r2 += square(apart[d]);
    }
    return r2;
}

/* Stiffness of the pair of entries k, l [N/m]. */
static inline real contact_stiffness(const struct contact *c, const struct particles *p, int64_t k, int64_t l)
{
    const int32_t i = c->particle[k], j = c->particle[l];
    return c->law.stiffness[p->material[i] * c->law.materials + p->material[j]] * (p->volume0[i] * p->volume0[j]);
}

/* Is there anything that may meet? */
static inline bool contact_works(const struct contact *c) { return c->law.between != CONTACT_NONE || c->rigids > 0; }

/* May something push the particle of the row? contact_follow_more, before each step without a search, has marked it. */
static inline bool contact_follows(const struct contact *c, int64_t row) { return c->followed[row] >= ROW_FELT; }
void contact_follow_more(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l);

/* Marks that count: of faces or pairs, of what is near a rigid body; NULL: overlaps do. */
static inline const uint8_t *contact_marks(const struct contact *c) { return c->by_overlap ? NULL : c->touch; }
static inline const uint8_t *contact_near_marks(const struct contact *c, int body)
{
    return c->by_overlap ? NULL : c->near[body].touch;
}
static inline bool contact_touches(const uint8_t *marks, int64_t k, bool overlaps)
{
    return marks ? marks[k] != 0 : overlaps;
}

/* Gaps by which marks are made: of a row of faces [spacings], of a pair, of an entry near a rigid body [m]. */
real contact_face_gap(const struct contact *c, const struct particles *p, int64_t row);
real contact_pair_gap(const struct contact *c, const struct particles *p, int64_t row, int64_t q);
real contact_rigid_gap(const struct contact *c, const struct particles *p, int body, int64_t q, real *normal);
/* The term of a row of faces, with room for all of its pairs. */
void contact_face_term(const struct contact *c, const struct particles *p, int64_t row, struct contact_term *term);
/* All that the list has may push. */
void contact_marks_follow(struct contact *c);
status contact_marks_archive(struct contact *c, struct archive *a);

static inline real contact_skin(const struct contact *c)
{
    return (c->marked ? STATIC_SKIN : CONTACT_SKIN) * c->law.spacing;
}

/* Row of particle i, -1: none. */
int64_t contact_row_of(const struct contact *c, int64_t i);

/* Width of the notch that lies between two entries in the reference state [m], 0: none. */
real contact_notch(const struct contact *c, const struct particles *p, int64_t k, int64_t l);

/* Images and spacings of the entries of the list. */
void contact_list_describe(struct contact *c, const struct particles *p);

/* One row: adds its force to part.f. */
void contact_pair_row(const struct contact *c, struct particles *p, int64_t row, struct contact_found *found);
real contact_pair_energy(const struct contact *c, const struct particles *p, int64_t row);
/* Distance d of a pair that is new on the list, or was there with distance `was` (NAN: not) [m]. */
real contact_pair_distance(const struct contact *c, const struct particles *p, int64_t k, int64_t l, real was);

void contact_profile_make(struct contact_profile *profile, int dim);
/* In two passes: what each particle feels, then the forces of all that feel something. */
void contact_face_feel(struct contact *c, const struct particles *p, int64_t row, real dt, struct contact_found *found);
void contact_face_row(const struct contact *c, struct particles *p, int64_t row);
real contact_face_energy(const struct contact *c, const struct particles *p, int64_t row);
/* Where contact begins for the particle of a row that is new on the list, or was row `was` of the list `before` (-1:
 * not): its energy does not change. */
void contact_face_begin(struct contact *c, const struct contact *before, int64_t was, const struct particles *p,
                        int64_t row);

/* Force along the rate of the gap of a row of stiffness K and energy 1/4 K gap^2; units as of gap and K. advance: a
 * step has been made since the last call. */
real contact_balance(struct contact_balance *b, real stiffness, real gap, bool advance);
/* The account of what has the gap `gap` and is new on the list, or was there with `before` (NULL: not). */
struct contact_balance contact_balance_begin(const struct contact_balance *before, real gap);

/* What entry l adds to what entry k feels: its weight; derivative of the energy of k over r [N/m]; from l to k [m]. */
struct contact_weight {
    real weight, pull, apart[DIM_MAX];
};
/* Computes these for the positions x - lag v [s]; the energy is the present one. */
struct contact_weight contact_weight(const struct contact *c, const struct particles *p, int64_t k, int64_t l,
                                     real lag);

/* A step of a spring: its face has the normal `normal` (0: left), the particle went `way` past it [m]; k [N/m]; most:
 * at which it gives way [N], 0 where both have parted. */
void contact_slide(struct contact_spring *s, int dim, const real *normal, const real *way, real k, real most);
/* In two passes, as of faces. */
void contact_face_slide(struct contact *c, const struct particles *p, int64_t row, real dt);
void contact_face_drag(const struct contact *c, struct particles *p, int64_t row);
real contact_friction_stored(const struct contact *c);
/* Makes room for the reactions of all rows; what they hold is computed with the next forces. */
void contact_reactions_make(struct contact *c);
void contact_springs_begin(struct contact *c, const struct contact *before);
void contact_spring_take(struct contact_spring *to, const struct contact_spring *before, int64_t at);
void contact_friction_settle(struct contact *c, const struct contact *before);

/* Particles within `skin` of rigid bodies [m]. */
void contact_rigid_find(struct contact *c, const struct contact *before, const struct particles *p, real skin);
void contact_rigid_free(struct contact *c);
/* Has a point of a body come so far since the search [m]? */
bool contact_rigid_has_come(const struct contact *c, real far);
void contact_rigid_force(struct contact *c, struct particles *p, real dt, struct contact_found *all);
status contact_rigid_archive(struct contact *c, struct archive *a);
/* Stores an array, or makes room for it and restores it. */
status contact_stored(struct archive *a, const char *name, void **array, int64_t count, size_t size);
real contact_rigid_energy(const struct contact *c, const struct particles *p);

#endif
