/* floor 3: cracks that grow as they are told: at a prescribed speed, or while the stress-intensity factors of a probe ask for
 * it. The tip runs on a straight line between changes of direction; a bond that it crosses fades out over the length that
 * the crack grows from then on (transition bonds, Imachi et al. 2019):
 *
 *     f_b = (1 - da/damping)^exponent,  0 <= da <= damping,  then 0;   damping = 0: released at once
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
    char probe[NAME_MAX_LENGTH];         /* sif probe that rules it; "": nothing does                       */
    real toughness;                      /* K_Ic: it grows while K_eq is at least this      [Pa m^(1/2)]    */
};

/* One fading entry of the rows: bond i-j, its weight when whole, one step ago and now, and the crack's length when it was
 * crossed. */
struct fading { int32_t i, j; float whole, before, now, spare; real length; };

struct growth {
    const struct growth_rule *rule;      /* borrowed                                                        */
    real place[2], along[2], speed;      /* now; speed 0 while it rests                             [m] [m/s] */
    real grown;                          /* length so far                                           [m]     */
    real start_time;                     /* of the first growth; NAN before                         [s]     */
    real turned_by[2];                   /* factors that it has turned by; NAN before     [Pa m^(1/2)]      */
    int64_t n, room;
    struct fading *fading;
};

void growth_make(struct growth *g, const struct growth_rule *rule);
void growth_free(struct growth *g);

/* One step: the tip advances, what it crosses begins to fade, what fades goes on. K NULL: no factors known; they turn the
 * crack to the direction of the largest hoop stress once it grows. Returns directed bonds that were released. */
int64_t growth_step(struct growth *g, struct bonds *b, struct particles *p, const struct bond_source *source,
                    const struct sif *K, real t, real dt);

status growth_archive(struct growth *g, int which, struct archive *a);

#endif
