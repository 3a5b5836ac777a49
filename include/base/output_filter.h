/* Protection of the terminal from control characters in the program's output. */
#ifndef CLEAVE_OUTPUT_FILTER
#define CLEAVE_OUTPUT_FILTER

/* Makes standard output and standard error print `?` in place of control characters and of characters that change the
 * direction of writing, whatever their source: headers of tables, names in input files, words of the command line. Line
 * feeds and tabs are kept; on standard error also the carriage return and the erasing of a line, which the progress
 * line needs. Call once, before anything is printed. */
void standard_streams_replace_control_characters(void);

#endif
