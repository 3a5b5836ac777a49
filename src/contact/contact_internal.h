/* Private header of the room: functions shared by the two forms of the law and by contact with rigid bodies. */
#ifndef CLEAVE_CONTACT_INTERNAL
#define CLEAVE_CONTACT_INTERNAL

#include "contact/contact.h"

#define CONTACT_REACH 2.0 /* range of the field of a face [mean spacings] */
#define CONTACT_SKIN 0.3  /* skin of the list beyond the contact distance [spacings] */
#define STATIC_SKIN 1.5   /* skin for the corrections of an equilibrium [spacings] */
#define FAR_LAMMPS 1.35   /* largest distance of pairs by the rule of LAMMPS [mean spacings] and ... */
#define NEAR_LAMMPS 0.9   /* ... [distance in the reference configuration] */
/* Reduction of a gap per displacement of a particle [1]: 2, as both sides move, and more where fields are curved. */
#define CONTACT_FLATNESS 3

/* State of a row until the next search: out of reach; in reach but at rest; neighbour of an active row, whose force
 * acts on it; active, its own contact is evaluated. */
enum row_state { ROW_FAR, ROW_NEAR, ROW_SOURCE, ROW_ACTIVE };

/* Sums over the rows of a step: pairs in contact, largest overlap. */
struct contact_found {
    real overlap;
    int64_t touching;
    int32_t deepest;
};

/* Adds a contact with this overlap [m] of a particle. */
static inline void contact_found_add(struct contact_found *to, real overlap, int32_t i)
{
    const bool first = overlap == to->overlap && i < to->deepest;
    if (overlap > to->overlap || first) to->overlap = overlap, to->deepest = i;
    to->touching++;
}

/* Computes the vector from entry l of the list to entry k [m]. Returns its square [m^2]. */
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

/* Returns the stiffness k of the pair of entries k, l [N/m]. */
static inline real contact_stiffness(const struct contact *c, const struct particles *p, int64_t k, int64_t l)
{
    const int32_t i = c->particle[k], j = c->particle[l];
    return c->law.stiffness[p->material[i] * c->law.materials + p->material[j]] * (p->volume0[i] * p->volume0[j]);
}

/* Returns true if contact is possible in this run. */
static inline bool contact_works(const struct contact *c) { return c->law.between != CONTACT_NONE || c->rigids > 0; }

/* Returns true if contact may push the particle of the row (contact_follow_more marks rows before each step). */
static inline bool contact_follows(const struct contact *c, int64_t row) { return c->followed[row] >= ROW_SOURCE; }

/* Marks further rows as active after particles at rest have moved; to be called in steps without a search. */
void contact_follow_more(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l);

/* Returns the marks that decide which contacts act, of faces, pairs or entries near a rigid body; NULL: overlaps
 * decide. */
static inline const uint8_t *contact_marks(const struct contact *c) { return c->by_overlap ? NULL : c->touch; }

/* Returns the marks of the entries near a rigid body; NULL: overlaps decide. */
static inline const uint8_t *contact_near_marks(const struct contact *c, int body)
{
    return c->by_overlap ? NULL : c->near[body].touch;
}

/* Returns true if contact k acts, by its mark or, without marks, by its overlap. */
static inline bool contact_touches(const uint8_t *marks, int64_t k, bool overlaps)
{
    return marks ? marks[k] != 0 : overlaps;
}

/* Returns the gap of a row of form `surface` by which its mark is set [spacings]. */
real contact_face_gap(const struct contact *c, const struct particles *p, int64_t row);

/* Returns the gap of pair q of a row [m]. */
real contact_pair_gap(const struct contact *c, const struct particles *p, int64_t row, int64_t q);

/* Returns the gap of entry q near a rigid body [m]. normal: of the surface of the body. */
real contact_rigid_gap(const struct contact *c, const struct particles *p, int body, int64_t q, real *normal);

/* Computes the spring term of a row of form `surface`; term has room for all pairs of the row. */
void contact_face_term(const struct contact *c, const struct particles *p, int64_t row, struct contact_term *term);

/* Marks all listed rows as active. */
void contact_marks_follow(struct contact *c);

/* Saves or restores the marks. */
status contact_marks_archive(struct contact *c, struct archive *a);

/* Returns the skin of the list [m]. */
static inline real contact_skin(const struct contact *c)
{
    return (c->marked ? STATIC_SKIN : CONTACT_SKIN) * c->law.spacing;
}

/* Returns the row of particle i, or -1. */
int64_t contact_row_of(const struct contact *c, int64_t i);

/* Returns the width of the notch between two entries in the reference configuration [m], 0 without a notch. */
real contact_notch(const struct contact *c, const struct particles *p, int64_t k, int64_t l);

/* Computes root, size and rise of all entries of the list. */
void contact_list_describe(struct contact *c, const struct particles *p);

/* Adds the force of the pairs of a row to p->f. */
void contact_pair_row(const struct contact *c, struct particles *p, int64_t row, struct contact_found *found);

/* Returns half the energy of the pairs of a row [J]. */
real contact_pair_energy(const struct contact *c, const struct particles *p, int64_t row);

/* Returns the contact distance d of a pair [m]. was: its distance on the previous list, NAN if it was not listed. */
real contact_pair_distance(const struct contact *c, const struct particles *p, int64_t k, int64_t l, real was);

/* Computes the table of depth by density for a square lattice. */
void contact_profile_make(struct contact_profile *profile, int dim);

/* Evaluates the contact of a row with the faces beside it: gap, derivatives of its energy. First of two passes, before
 * contact_face_row. dt: step since the last call [s]. */
void contact_face_evaluate(struct contact *c, const struct particles *p, int64_t row, real dt,
                           struct contact_found *found);

/* Adds the contact force on the particle of a row to p->f: second of two passes. */
void contact_face_row(const struct contact *c, struct particles *p, int64_t row);

/* Returns the contact energy of a row [J]. */
real contact_face_energy(const struct contact *c, const struct particles *p, int64_t row);

/* Determines where contact begins for a row. was: its row on the list `before`, -1: not listed. The energy of a row
 * that was listed does not change. */
void contact_face_begin(struct contact *c, const struct contact *before, int64_t was, const struct particles *p,
                        int64_t row);

/* Returns the force along the rate of the gap for a row of stiffness K and energy 1/4 K gap^2, in the units of K gap.
 * advance: a step was done since the last call. */
real contact_balance(struct contact_balance *b, real stiffness, real gap, bool advance);

/* Returns the account of a row with gap `gap`. before: its account on the previous list, NULL: new on the list. */
struct contact_balance contact_balance_begin(const struct contact_balance *before, real gap);

/* Contribution of entry l to the field at entry k: weight; derivative of the energy of k by r over r [N/m]; vector from
 * l to k [m]. */
struct contact_weight {
    real weight, pull, apart[DIM_MAX];
};

/* Computes the contribution at the positions x - lag v [s]; the energy is that of the present positions. */
struct contact_weight contact_weight(const struct contact *c, const struct particles *p, int64_t k, int64_t l,
                                     real lag);

/* Advances a friction spring by a step. normal: of the face (0: contact ended); slid: displacement of the particle
 * relative to the face [m]; k [N/m]; most: force at which the spring slides [N], 0 after separation. */
void contact_slide(struct contact_spring *s, int dim, const real *normal, const real *slid, real k, real most);

/* Advances the friction spring of a row by a step dt [s]; first of two passes, before contact_face_drag. */
void contact_face_slide(struct contact *c, const struct particles *p, int64_t row, real dt);

/* Adds friction on the particle of a row and the reactions of rows whose face contains it to p->f: second of two
 * passes. */
void contact_face_drag(const struct contact *c, struct particles *p, int64_t row);

/* Returns the energy stored in all friction springs [J]. */
real contact_friction_stored(const struct contact *c);

/* Allocates the reactions of all rows; they are computed with the next forces. */
void contact_reactions_make(struct contact *c);

/* Allocates the springs of a new list and copies those of rows that were listed before. */
void contact_springs_begin(struct contact *c, const struct contact *before);

/* Copies spring number `at` of a previous list (NULL or -1: none) to *to. */
void contact_spring_take(struct contact_spring *to, const struct contact_spring *before, int64_t at);

/* Sets the work of friction of a new list to that of the list before, plus the energy of springs that no longer
 * exist. */
void contact_friction_settle(struct contact *c, const struct contact *before);

/* Lists the particles within `skin` [m] of each rigid body. before: the previous list. */
void contact_rigid_find(struct contact *c, const struct contact *before, const struct particles *p, real skin);

/* Releases the lists near rigid bodies. */
void contact_rigid_free(struct contact *c);

/* Returns true if a point of a rigid body has moved by `far` [m] or more since the last search. */
bool contact_rigid_has_moved(const struct contact *c, real far);

/* Computes the contact forces of all rigid bodies on particles and the reactions on the bodies. */
void contact_rigid_force(struct contact *c, struct particles *p, real dt, struct contact_found *all);

/* Saves or restores the lists near rigid bodies. */
status contact_rigid_archive(struct contact *c, struct archive *a);

/* Saves an array [count] of elements of `size` bytes, or allocates and restores it. */
status contact_stored(struct archive *a, const char *name, void **array, int64_t count, size_t size);

/* Returns the energy of contact with all rigid bodies [J]. */
real contact_rigid_energy(const struct contact *c, const struct particles *p);

#endif
