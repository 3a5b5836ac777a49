/* floor 3: cracks that grow as they are told: at a prescribed speed, or while the stress-intensity factors of a probe
 * ask for it. The tip runs on a straight line between changes of direction; a bond that it crosses fades out over the
 * length that the crack grows from then on (transition bonds, Imachi et al. 2019):
 *
 *     f_b = (1 - da/damping)^exponent,  0 <= da <= damping,  then 0;   damping = 0: released at once
 *
 * A ruled crack turns by theta_c(K), the direction of the largest hoop stress, away from the direction in whose frame K
 * was taken. That direction is the mean of where the tip headed, over the `smoothing` length of growth:
 *
 *     d(along)/da = (heading - along)/smoothing
 *
 * A tip that turns at once and is measured in its new frame, round a ring that its kink has not crossed, finds K_II
 * reversed: theta_c = -2 K_II/K_I for small K_II is twice the turn that removes it, and the path swings at every sample.
 *
 * Both entries of a bond fade alike, so momentum stays exact; the energy that fading takes is fracture energy. A crack
 * that comes to rest keeps its bonds as they are. */
#ifndef CLEAVE_GROWTH_H
#define CLEAVE_GROWTH_H

#include "archive.h"
#include "bonds.h"
#include "cells.h"
#include "sif.h"

/* As the scene asks for it. */
struct growth_rule {
    char name[NAME_MAX_LENGTH];
    real at[DIM_MAX];                    /* where the tip starts                                    [m]     */
    real direction[DIM_MAX];             /* unit vector                                                     */
    real speed;                          /* of the tip                                              [m/s]   */
    real start;                          /* it does not move before                                 [s]     */
    real length;                         /* it stops there; INFINITY: never                         [m]     */
    real damping, exponent;              /* damping NAN: half a horizon                             [m] [1] */
    real smoothing;                      /* with a probe, NAN: a quarter of a horizon                   [m] */
    char probe[NAME_MAX_LENGTH];         /* sif probe that rules it; "": nothing does                       */
    real toughness;                      /* K_Ic: it grows while K_eq is at least this      [Pa m^(1/2)]    */
};

/* Factors that rule a crack, and the direction of the tip in whose frame they were taken: the crack turns away from that
 * one, however often it is asked before the next factors are known. */
struct ruling { struct sif factors; real along[2]; };

/* One fading entry of the rows: bond i-j, its weight when whole, one step ago and now, and the crack's length when it was
 * crossed. */
struct fading { int32_t i, j; float whole, before, now, spare; real length; };

struct growth {
    const struct growth_rule *rule;      /* borrowed                                                        */
    real place[2], along[2], speed;      /* now; speed 0 while it rests                             [m] [m/s] */
    real heading[2];                     /* unit vector: where it goes; `along` is the mean of where it came from */
    real grown;                          /* length so far                                           [m]     */
    real start_time;                     /* of the first growth; NAN before                         [s]     */
    real intensity;                      /* K_eq of the ruling factors; NAN: none known      [Pa m^(1/2)]    */
    int64_t n, room;
    struct fading *fading;
};

void growth_make(struct growth *g, const struct growth_rule *rule);
void growth_free(struct growth *g);

/* One step: the tip advances, what it crosses begins to fade, what fades goes on. `ruling` NULL: no factors known; they
 * turn the crack to the direction of the largest hoop stress once it grows. Returns directed bonds that were released. */
int64_t growth_step(struct growth *g, struct bonds *b, struct particles *p, const struct bond_source *source,
                    const struct ruling *ruling, real t, real dt);

/* Angle of the chord from where it started against the direction then, 0..180 [degree]; NAN before it has grown. */
real growth_angle(const struct growth *g);

status growth_archive(struct growth *g, int which, struct archive *a);

#endif
