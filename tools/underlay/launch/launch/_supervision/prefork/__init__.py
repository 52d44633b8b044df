# SPDX-License-Identifier: Apache-2.0
"""
Fork Python programs from a template process that has already imported their modules.

In the launch: `prefork` decides what to fork, `eligibility` determines which programs can be
forked, and `template_handle` starts the template and requests processes from it. In the template:
`template` is its main program, and `cloning`, `starting_point`, `standard_streams` and `title` set
up a copy of it as if the program had been executed.
"""
