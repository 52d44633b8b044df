# SPDX-License-Identifier: Apache-2.0
"""
Fork Python programs from a template process that has imported what they need.

In the launch: `prefork` decides, `eligibility` tells which programs can be forked, and
`template_handle` starts the template and asks it for processes. In the template: `template` is
its main program, and `cloning`, `starting_point`, `standard_streams` and `title` turn a copy of it
into what the program would have been if it had been executed.
"""
