/* SPDX-License-Identifier: MIT */
/* A library that is no FMU. */
int nothing;

#ifdef WANTS_PYTHON /* from the program that loads it, as FMUs that run Python do */
extern int _Py_NoneStruct;
const void* none(void) { return &_Py_NoneStruct; }
#endif
