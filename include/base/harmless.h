/* What the program prints never acts on a terminal. */
#ifndef CLEAVE_HARMLESS
#define CLEAVE_HARMLESS

/* Makes standard output and standard error print `?` in place of control characters and of marks that turn the
 * direction of writing, wherever they come from: headers of tables, names in scenes, words of the command line. Line
 * feeds and tabs stay; so do, on standard error, the carriage return and the erasing of a line by which progress is
 * shown. Call this once, before anything is printed. */
void harmless_output_start(void);

#endif
