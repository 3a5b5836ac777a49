/* Writes the boundary conditions of the scene as run. */
#include "scene_echo.h"

/* Writes the key `time` of the boundary condition b to scene.yaml (w), for a function of time that is read from a
 * file: name and column of the file. */
static void write_time_file(struct yaml_writer *w, const struct boundary *b)
{
    yaml_write_key(w, "time");
    fputc('\n', w->out);
    w->indent += 2;
    yaml_write_file_path_and_hash(w, "file", b->time_file, b->time_contents);
    if (b->time_column[0]) {
        yaml_write_key(w, "column");
        fputc(' ', w->out);
        yaml_write_quoted_text(w, b->time_column);
        fputc('\n', w->out);
    }
    w->indent -= 2;
}

/* Writes the key `time` of the boundary condition b to scene.yaml (w): the factor by which the value of b varies in
 * time. */
static void write_time(struct yaml_writer *w, const struct boundary *b)
{
    const struct time_function *f = &b->time;
    if (b->time_file) {
        write_time_file(w, b);
        return;
    }
    static const char *const words[] = {[TIME_STEP] = "step", [TIME_PULSE] = "pulse", [TIME_RAMP] = "ramp"};
    yaml_write_key(w, "time");
    if (f->kind == TIME_CONSTANT)
        fputs(" constant", w->out);
    else if (f->kind == TIME_TABLE)
        fputs(" {table: [", w->out);
    else {
        fprintf(w->out, " {%s: {from: ", words[f->kind]);
        yaml_write_real(w, f->from);
        fputs(", until: ", w->out);
        yaml_write_real(w, f->until);
        fputs("}}", w->out);
    }
    for (int k = 0; k < f->n; k++) {
        real row[2] = {f->t[k], f->value[k]};
        fputs(k ? ", " : "", w->out);
        yaml_write_number_list(w, row, 2);
    }
    fputs(f->kind == TIME_TABLE ? "]}\n" : "\n", w->out);
}

static void write_profile(struct yaml_writer *w, const struct profile *f)
{
    const char *group = "boundary.profile.sine", *between = " {sine: {";
    yaml_write_key(w, "profile");
    for (int i = 0; i < keys_count && f->kind == PROFILE_SINE; i++) {
        if (!key_is_directly_below(&keys[i], group)) continue;
        fprintf(w->out, "%s%s: ", between, key_get_last_name_of_path(&keys[i]));
        yaml_write_value(w, &keys[i], key_get_value_address_in_group(&keys[i], f));
        between = ", ";
    }
    fputs(f->kind == PROFILE_SINE ? "}}\n" : " uniform\n", w->out);
}

/* Writes component d of a vector to scene.yaml (w): the formula formula[d] if it is given, else the number value[d]. */
static void write_formula(struct yaml_writer *w, const real *value, const struct expression *formula, int d)
{
    if (formula[d].n > 0)
        yaml_write_quoted_text(w, formula[d].text);
    else
        yaml_write_real(w, value[d]);
}

void yaml_write_vector_of_formulas(struct yaml_writer *w, const char *key, const real *value,
                                   const struct expression *formula)
{
    yaml_write_key(w, key);
    for (int d = 0; d < w->scene->dim; d++) {
        fputs(d ? ", " : " [", w->out);
        write_formula(w, value, formula, d);
    }
    fputs("]\n", w->out);
}

static void write_rotation(struct yaml_writer *w, const struct boundary *b)
{
    yaml_write_group_as_mapping(w, "rotation", "boundary.rotation", b);
    if (w->scene->dim < 3) return;
    w->indent += 2;
    yaml_write_key(w, "axis");
    fputc(' ', w->out);
    yaml_write_number_list(w, b->axis_of, DIM_MAX);
    fputc('\n', w->out);
    w->indent -= 2;
}

static void write_velocity(struct yaml_writer *w, const struct boundary *b)
{
    yaml_write_key(w, b->displaces ? "displacement" : "velocity");
    for (int d = 0; d < w->scene->dim; d++) {
        fputs(d ? ", " : " [", w->out);
        if (b->components >> d & 1)
            write_formula(w, b->value, b->formula, d);
        else
            fputs("free", w->out);
    }
    fputs("]\n", w->out);
}

/* Writes the boundary condition b to scene.yaml (w): the keys of the table, then value, face, depth, profile and time
 * as the kind of b requires. */
static void write_boundary(struct yaml_writer *w, const struct boundary *b)
{
    yaml_write_keys_of_group(w, "boundary", b);
    if (b->kind == BOUNDARY_MIRROR) {
        yaml_write_group_as_mapping(w, "mirror", "boundary.mirror", b);
        return;
    }
    if (b->rotates) {
        write_rotation(w, b);
    } else if (b->kind == BOUNDARY_VELOCITY) {
        write_velocity(w, b);
    } else if (b->kind == BOUNDARY_ABSORBING) {
        yaml_write_key(w, "absorbing");
        fputs(" true\n", w->out);
    } else if (b->kind == BOUNDARY_PRESSURE) {
        yaml_write_key(w, "pressure");
        fputc(' ', w->out);
        write_formula(w, b->value, b->formula, 0);
        fputc('\n', w->out);
    } else {
        yaml_write_vector_of_formulas(w, b->kind == BOUNDARY_TRACTION ? "traction" : "body_force", b->value,
                                      b->formula);
    }
    if (b->side != 0) {
        yaml_write_key(w, "face");
        fprintf(w->out, " %c%c\n", 'x' + b->face, b->side > 0 ? '+' : '-');
    }
    if (b->side != 0 && b->kind == BOUNDARY_VELOCITY) {
        yaml_write_key(w, "depth");
        fputc(' ', w->out);
        yaml_write_real(w, b->depth);
        fputc('\n', w->out);
    }
    if (b->kind == BOUNDARY_BODY_FORCE) write_profile(w, &b->profile);
    if (b->kind != BOUNDARY_ABSORBING) write_time(w, b);
}

void yaml_write_boundaries(struct yaml_writer *w)
{
    const struct scene *s = w->scene;
    const bool falls = s->boundaries > 0 && s->boundary[s->boundaries - 1].by_mass; /* gravity is a key of its own */
    const int n = s->boundaries - falls;
    if (n) fputs("boundary:\n", w->out);
    for (int k = 0; k < n; k++) {
        yaml_begin_list_item(w);
        write_boundary(w, &s->boundary[k]);
    }
}
