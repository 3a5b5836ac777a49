/* Writes in.lammps. The order of commands matters: bonds are created from the first neighbour list at rest, by a run of
 * zero steps; a second such run lets peri/lps of 2021 compute its stretches before anything moves, without which every
 * bond would break at once. */
#include <math.h>

#include "export_parts.h"
#include "step/report.h"

#define SKIN 0.3         /* skin of the neighbour list [spacings] */
#define FRAMES_MOST 1000 /* largest number of frames at irregular steps, each a term of a variable of LAMMPS */
#define FAR 0.5          /* stretch beyond which ghost particles of unbreakable bonds may be lost */

static real stretch_of(const struct lammps_export *x, int a, int b)
{
    const real limit = x->e->tables.pair_stretch[a * x->s->materials + b];
    return isfinite(limit) ? limit : 1e30;
}

static real modulus_of(const struct lammps_export *x, int a, int b)
{
    const struct family *f = &x->e->source.family;
    const real first = family_micro_modulus(f, &x->s->material[a]),
               second = family_micro_modulus(f, &x->s->material[b]);
    return first == second ? first : 2 * first * second / (first + second);
}

/* Writes the coefficients of the material law for bonds between the materials a and b of the export x to the LAMMPS
 * script `to`, as arguments of pair_coeff or bond_coeff. In 2D, the shear and bulk moduli G_L = 8 G/15 and K_L = 4
 * (lambda + G)/9 turn the 3D law of LAMMPS into the 2D law. */
static void law_write(FILE *to, const struct lammps_export *x, int a, int b)
{
    const struct material *m = &x->s->material[a];
    if (x->s->model == MODEL_BOND)
        fprintf(to, "%.17g", modulus_of(x, a, b));
    else if (x->s->dim == 3)
        fprintf(to, "%.17g %.17g", m->c12 + 2 * m->shear / 3, m->shear);
    else
        fprintf(to, "%.17g %.17g", 4 * (m->c12 + m->shear) / 9, 8 * m->shear / 15);
    fprintf(to, " %.17g %.17g 0.0\n", x->cutoff, stretch_of(x, a, b));
}

/* Writes the particle types of material number `material` to the LAMMPS script `to` as a range FIRST*LAST; the types of
 * one material are numbered consecutively. t: particle types, from 1. */
static void types_of(FILE *to, const struct lammps_types *t, int material)
{
    int first = 0, last = 0;
    for (int k = 1; k <= t->n; k++)
        if (t->material[k] == material) first = first ? first : k, last = k;
    fprintf(to, " %d*%d", first, last);
}

/* Returns true if material number `material` has particles, i.e. if one of the particle types t of LAMMPS has this
 * material. */
static bool is_there(const struct lammps_types *t, int material)
{
    bool there = false;
    for (int k = 1; k <= t->n; k++) there |= t->material[k] == material;
    return there;
}

static void pairs_write(FILE *to, const struct lammps_export *x, const struct lammps_types *t)
{
    fprintf(to, "pair_style peri/%s\n", x->s->model == MODEL_BOND ? "pmb" : "lps");
    for (int a = 0; a < x->s->materials; a++)
        for (int b = a; b < x->s->materials; b++) {
            if (!is_there(t, a) || !is_there(t, b)) continue;
            fputs("pair_coeff", to);
            types_of(to, t, a);
            types_of(to, t, b);
            fputc(' ', to);
            law_write(to, x, a, b);
        }
    if (t->pairs == 0) return;
    fputs("\n# Pairs of types that no bond may join, while bonds are made: cracks\n", to);
    for (int64_t k = 0; k < t->pairs; k++) {
        const int a = t->pair[k][0], b = t->pair[k][1];
        fprintf(to, "neigh_modify exclude type %d %d\n", a < b ? a : b, a < b ? b : a);
    }
}

static void bond_style_write(FILE *to, const struct lammps_export *x)
{
    int type = 0;
    fprintf(
        to,
        "# pair_style bpm/peri of 2026 would push apart all pairs nearer than 1.35 spacings that no bond joins, the "
        "faces of cracks\n# from the start on: no contact\npair_style zero %.17g\npair_coeff * *\n"
        "bond_style bpm/peri\n",
        x->cutoff);
    for (int a = 0; a < x->s->materials; a++)
        for (int b = a; b < x->s->materials; b++) {
            fprintf(to, "bond_coeff %d %s ", ++type, x->s->model == MODEL_BOND ? "pmb" : "lps");
            law_write(to, x, a, b);
        }
}

static void settings_write(FILE *to, const struct lammps_export *x)
{
    const real h = x->s->spacing;
    real stretch = FAR;
    for (int k = 0; k < x->s->materials * x->s->materials && scene_bonds_can_break(x->s); k++)
        stretch = real_min(stretch, real_max(0, x->e->tables.pair_stretch[k]));
    fprintf(to, "units si\nboundary m m m\natom_style %s\natom_modify map array sort 0 0.0\n",
            x->bond_style ? "bond" : "peri");
    if (x->s->dim == 2) fputs("processors * * 1\n", to);
    if (x->bond_style) fputs("newton on off\nspecial_bonds lj 0.0 1.0 1.0 coul 1.0 1.0 1.0\n", to);
    fprintf(to,
            "neighbor %.17g bin\nneigh_modify delay 0 every 1 check yes\ncomm_modify cutoff %.17g\n# lattice constant: "
            "the width of the volume ramp at the horizon, and the length scale of contact\nlattice sc %.17g\n",
            SKIN * h, x->cutoff * (1 + stretch) + (1 + SKIN) * h, x->lattice);
}

static void particles_write(FILE *to, const struct lammps_export *x)
{
    if (x->columns == 0 && !x->bond_style) {
        fputs("read_data plate.data\n", to);
        return;
    }
    fprintf(to, "fix columns all property/atom%s", x->bond_style ? " d_vfrac d_damage" : "");
    lammps_write_per_particle_column_names(to, x);
    fprintf(to, "%s\nread_data plate.data fix columns NULL Columns\n", x->bond_style ? " ghost yes" : "");
    lammps_write_compute_commands(to, x);
    if (x->bond_style) fputs("compute damage all property/atom d_damage\n", to);
}

/* Writes the LAMMPS commands of the export x between the creation of bonds and the run to the script `to`: two runs of
 * zero steps, then initial displacements and time integration. Pairs of types that were excluded while bonds were
 * created are no longer excluded, since excluded pairs cannot come into contact. t: particle types, with these
 * pairs. */
static void start_write(FILE *to, const struct lammps_export *x, const struct lammps_types *t)
{
    fprintf(to, "\ntimestep %.17g\nthermo 1000\n", x->e->clock.dt);
    if (x->displaced) /* variables may use only quantities computed in the current step */
        fprintf(to, "compute starts all reduce max c_startx c_starty%s\nthermo_style custom step c_starts[1]\n",
                x->s->dim > 2 ? " c_startz" : "");
    fputs("run 0 post no\nrun 0 post no\n", to);
    if (t->pairs > 0) fputs("neigh_modify exclude none\n", to);
    if (x->s->contact_between == CONTACT_NONE && !x->bond_style)
        fputs("neigh_modify exclude group all all    # no contact: bonds do not need the list\n", to);
    if (x->displaced) {
        for (int d = 0; d < x->s->dim; d++) fprintf(to, "variable start%c atom c_start%c\n", 'x' + d, 'x' + d);
        fprintf(to, "displace_atoms all move v_startx v_starty %s units box\nthermo_style one\n",
                x->s->dim > 2 ? "v_startz" : "0.0");
    }
    fputs("fix motion all nve\n", to);
}

/* Writes, as a comment of the LAMMPS script `to`, the command that compares the results of LAMMPS after `steps` time
 * steps with check.csv. The command works on a machine without Cleave. */
static void test_write(FILE *to, int64_t steps)
{
    fprintf(to,
            "\n# Test: largest difference from Cleave over the largest displacement after %lld steps (1e-9: "
            "round-off), and of damage:\n# awk -F '[ ,]' 'NR == FNR {for (k = 2; k < 9; k++) a[$1, k] = $k; n[$1]; "
            "next} /TIMESTEP/ {getline; t = $1} t == %lld && NF > 4 && $1 in n "
            "{for (k = 2; k < 5; k++) {d[k] = $k - a[$1, k + 3]; u[k] = a[$1, k + 3] - a[$1, k]} "
            "e = d[2]^2 + d[3]^2 + d[4]^2; r = u[2]^2 + u[3]^2 + u[4]^2; if (e > E) E = e; if (r > R) R = r; "
            "f = $5 - a[$1, 8]; if (f < 0) f = -f; if (f > F) F = f} END {print sqrt(E / R), F + 0}' check.csv "
            "check.dump\n",
            (long long)steps, (long long)steps);
}

/* Returns the number of time steps from each frame (output of all particles) of the run to the next if it is the same
 * for all frames, else 0. frames: number of frames. */
static int64_t frame_distance(const struct run *run, int64_t frames)
{
    const int64_t first = report_step_number_of_frame(run->scene, &run->clock, 1);
    for (int64_t k = 2; k <= frames; k++)
        if (report_step_number_of_frame(run->scene, &run->clock, k) != k * first) return 0;
    return first;
}

/* Writes the LAMMPS command `dump` of the export x to the script `to`, with output at exactly the steps of Cleave's
 * frames (outputs of all particles). If their distance varies, a variable returns the step of the next frame; with more
 * than FRAMES_MOST such frames, the dump has a constant distance. */
static void frames_write(FILE *to, const struct lammps_export *x)
{
    static const char columns[] = "plate.dump id x y z vx vy vz c_damage\n"
                                  "dump_modify frames sort id format float %.17g";
    const struct run *run = x->e;
    const int64_t frames = report_frame_count_of_run(run->scene, &run->clock), steps = run->clock.steps;
    int64_t every = frames > 0 ? frame_distance(run, frames) : steps;
    if (every == 0 && frames > FRAMES_MOST) {
        every = steps / frames;
        fputs("# more frames than a variable takes: these are not at the steps of Cleave's\n", to);
    }
    if (every > 0) {
        fprintf(to, "dump frames all custom %lld %s\n", (long long)every, columns);
        return;
    }
    fprintf(to, "variable next equal %lld", (long long)report_step_number_of_frame(run->scene, &run->clock, 1));
    for (int64_t k = 1; k <= frames; k++) {
        const int64_t here = report_step_number_of_frame(run->scene, &run->clock, k),
                      next = k < frames ? report_step_number_of_frame(run->scene, &run->clock, k + 1) : steps + 1;
        if (next > here) fprintf(to, "+(step>=%lld)*%lld", (long long)here, (long long)(next - here));
    }
    fprintf(to, "\ndump frames all custom %lld %s every v_next first yes\n", (long long)steps, columns);
}

static void runs_write(FILE *to, const struct lammps_export *x)
{
    const int64_t steps = x->e->clock.steps, check = lammps_comparison_step_count(x);
    if (!x->bond_style) fputs("\ncompute damage all damage/atom\n", to);
    frames_write(to, x);
    fprintf(to,
            "dump check all custom %lld check.dump id x y z c_damage\ndump_modify check sort id format float %%.17g\n"
            "run %lld\nundump check\n",
            (long long)check, (long long)check);
    if (steps > check) /* recomputed forces would lack the last forces of bonds that have just broken */
        fprintf(to, "run %lld pre no\n", (long long)(steps - check));
    test_write(to, check);
}

void lammps_script_write(FILE *file, const struct lammps_export *x, const struct lammps_types *types)
{
    fprintf(file, "# %s, exported by Cleave %s for %s\n", x->s->name, CLEAVE_VERSION,
            x->bond_style ? "bond_style bpm/peri (LAMMPS of September 2026 and later, package BPM)"
                          : "pair_style peri (LAMMPS with package PERI, as Debian's of 2021)");
    settings_write(file, x);
    particles_write(file, x);
    if (x->bond_style)
        bond_style_write(file, x);
    else
        pairs_write(file, x, types);
    start_write(file, x, types);
    lammps_loads_write(file, x, types);
    runs_write(file, x);
}
