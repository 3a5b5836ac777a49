/* Room `fracture` (folder of include/ and src/): positions, driving forces and growth of cracks. The room uses bonds
 * and particles; probes and the engine use it.
 *
 * This header: crack tips, tracked from sample (line of history.csv) to sample.
 *
 * A tip starts at the end of a pre-crack inside the body, or where the damage of a particle away from all known cracks
 * exceeds 0.35. A particle whose damage exceeds 0.35 belongs to a crack if it touches a particle of the crack or is
 * within 2.5 spacings of the start. Particles of one body touch if their reference positions are at most 1.5 spacings
 * apart. Particles damaged by a pre-crack at t = 0 and particles with prescribed motion belong to no crack. The tip is
 * at the particle of the crack that is farthest from the start, at the mean of several equally far ones that touch each
 * other; of equally far ones in separate groups, as on two branches, one group is chosen (fracture/places.h). Particles
 * beside the last 2.5 spacings of the pre-crack do not count as growth.
 *
 * If two cracks touch, one becomes part of the other, except in three cases: both start at pre-cracks; both have grown
 * by more than three spacings, in directions less than 90 degrees apart, and touch behind both tips; or the longer
 * crack would become shorter, because its length would be measured from the start of the other one. In 3D every edge of
 * a pre-crack inside the body is one front, whose start is the whole edge. */
#ifndef CLEAVE_TIPS
#define CLEAVE_TIPS

#include "base/archive.h"
#include "bonds/bonds.h"
#include "data/cells.h"
#include "data/particles.h"
#include "data/region.h"

/* Damage (fraction of broken bonds, 0 to 1) above which a particle counts as part of a crack. */
#define TIP_DAMAGE 0.35
/* Largest number of tips that are tracked. */
enum { TIPS_MAX = 64 };

/* A crack tip that is tracked from sample to sample: where it started, present position, growth and speed. body: number
 * of the body in which the tip is. */
struct crack_tip {
    bool from_crack; /* starts at the end of a pre-crack */
    int body;
    int number;           /* of the crack, from 1 in the order in which cracks begin; a new one when it joins another */
    real origin[DIM_MAX]; /* start [m] */
    real along[DIM_MAX];  /* unit direction of the pre-crack at the start; without a pre-crack the x axis */
    real edge[DIM_MAX];   /* 3D: half the edge of the front, origin -+ edge are its ends; else 0 [m] */
    real place[DIM_MAX];  /* present reference position [m] */
    real growth;          /* distance from the start, 3D: from the edge of the front [m] */
    real joined;     /* part of the growth that came from joining another crack, and does not count for the speed [m] */
    real first_time; /* time at which the damage of a particle first exceeded 0.35 [s]; NAN: not yet */
    /* time when growth exceeded one spacing; time of the last growth [s]; NAN: none so far */
    real start_time, arrest_time;
    /* largest regression slope of the growth over the time `window`; growth divided by (arrest_time - start_time)
     * [m/s] */
    real speed_max, speed_mean;
    int64_t particles; /* number of particles of the crack */
    int64_t ends;      /* number of separate groups of particles that are as far as the tip, within a spacing */
};

/* All crack tips of a run, tip[n], in dim dimensions; the crack to which each particle belongs; and the growth recorded
 * at `samples` times. The arrays are owned. */
struct crack_tips {
    int dim, n;
    int begun; /* largest number of a crack so far */
    struct crack_tip tip[TIPS_MAX];
    real spacing, window; /* spacing of the particles [m], window of the speed [s] */
    int64_t count;        /* number of particles */
    uint8_t *label;       /* [particles] tip + 1; 0: no crack, 255: damaged by a pre-crack */
    int64_t samples;
    real *time;   /* [samples] time of each sample [s] */
    real *growth; /* [samples][TIPS_MAX] growth of every tip, without `joined` [m] */
};

/* Returns true if one of the crack tips t started at `end` (t->dim coordinates [m]), an end of a pre-crack. This is so
 * if the end is inside a body and not at a face of it. */
bool tips_any_started_at_precrack_end(const struct crack_tips *t, const real *end);

/* Excludes from all cracks the particles that pre-cracks damage by more than TIP_DAMAGE, so that crack tips do not grow
 * through them. Needed for pre-cracks that are slits (free surfaces) of the mesh. t: crack tips; cut_fraction: for each
 * particle, the share (0 to 1) of its bonds that pre-cracks cut once the particle has bonds. */
void tips_ignore_particles_damaged_by_precracks(struct crack_tips *t, const real *cut_fraction);

/* Initialises t and adds a tip for every end of a pre-crack inside the body. p: particles, whose damage must already
 * include the pre-cracks; c: neighbour search over the reference positions; precrack: `precrack_count` pre-cracks;
 * spacing: of the particles [m]; speed_averaging_time: time interval over which tip speeds are averaged [s]. Release
 * with tips_free. */
void tips_make_at_precrack_ends(struct crack_tips *t, const struct particles *p, const struct cells *c,
                                const struct crack *precrack, int precrack_count, real spacing,
                                real speed_averaging_time);

/* Assigns to cracks those particles whose damage has exceeded TIP_DAMAGE since the last call, and updates position,
 * growth and speed of all tips in t. Where the damage is away from all cracks, a new tip starts. p: particles with
 * their present damage; c: neighbour search over the reference positions; time: present time [s]. */
void tips_update_from_damage(struct crack_tips *t, const struct particles *p, const struct cells *c, real time);

/* Returns the angle [degree], 0 to 180, between the direction of the pre-crack and the straight line from the start of
 * the crack `tip` to its tip; NAN if the crack has not grown. dim: dimension of the body. */
real tip_deflection_angle(const struct crack_tip *tip, int dim);

/* Returns the speed [m/s] of tip number `tip` (from 0): the regression slope of its growth over the last t->window
 * seconds, or 0 if fewer than two samples have been taken. */
real tips_average_speed(const struct crack_tips *t, int tip);

/* Returns the tip with the largest growth, a pointer into t, or NULL if no tip has grown. */
const struct crack_tip *tips_find_tip_with_largest_growth(const struct crack_tips *t);

/* Returns the number of crack ends (a branched crack has several) of all tips in t whose growth is within one particle
 * spacing of the largest growth; 0 if no tip has grown. */
int64_t tips_count_crack_ends_with_largest_growth(const struct crack_tips *t);

/* Returns true if the crack of `tip` grows along a plane of symmetry, so that the modelled body has only one face of
 * the crack. t: all tips, with the spacing of the particles; mirror: `mirror_count` planes of symmetry. */
bool tip_grows_on_mirror_plane(const struct crack_tips *t, const struct crack_tip *tip,
                               const struct mirror_plane *mirror, int mirror_count);

/* Moves the tips of t that grow along a plane of symmetry and have stayed beside it into the plane, where the middle of
 * the tip and its mirror image is. mirror: `mirror_count` planes of symmetry. */
void tips_snap_onto_mirror_planes_they_grow_along(struct crack_tips *t, const struct mirror_plane *mirror,
                                                  int mirror_count);

/* Properties of the body on which the area of its cracks depends: planes of symmetry, mirror[mirrors], cross-section,
 * and damage beside a crack. */
struct tip_surroundings {
    const struct mirror_plane *mirror; /* [mirrors] planes of symmetry */
    int mirrors;
    real section; /* thickness in 2D [m], cross-section in 1D [m^2], 1 in 3D */
    real half;    /* half the damage that a plane cut gives to the particles beside it [1] */
};

/* Area of cracks [m^2]. face: area of one of the two faces; own: area whose fracture energy the modelled body has
 * spent, half of `face` for a crack in a plane of symmetry, else `face`. */
struct crack_area {
    real face, own;
};

/* Returns the area [m^2] of one face of all cracks t of the particles p, as of the last sample (line of history.csv).
 * For a crack that starts at a pre-crack it is the sum of the growth over strips one spacing wide along the front;
 * branches do not count. For any other crack it is half the number of its particles, since particles of both faces are
 * counted, times the area of a particle; in a plane of symmetry, where only one face is modelled, the whole number. The
 * member `own` of the result contains only half of the area of cracks in planes of symmetry. s: planes of symmetry and
 * thickness. */
struct crack_area tips_total_crack_area(const struct crack_tips *t, const struct particles *p,
                                        const struct tip_surroundings *s);

/* Returns the total area [m^2] of the breaks through a bar (1D). A break is a position in the bar where load has broken
 * every bond of b across it. A break in a plane of symmetry counts half in the member `own`. p: particles;
 * cross_section: cross-section of the bar [m^2]. */
struct crack_area bar_total_crack_area(const struct bonds *b, const struct particles *p, real cross_section);

/* Frees the arrays of the crack tips t. */
void tips_free(struct crack_tips *t);

/* Saves the crack tips t, the crack to which each particle belongs and the recorded samples to the archive `a`
 * (checkpoint file or memory) if a->saving, else restores them from it. Returns FAILED if the archive cannot be read or
 * written or a stored size differs. */
status tips_save_or_load(struct crack_tips *t, struct archive *a);

#endif
