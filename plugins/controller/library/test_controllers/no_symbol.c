/* SPDX-License-Identifier: MIT
 * A shared library that is no control code. */
int some_function(void);
int some_function(void) { return 0; }
