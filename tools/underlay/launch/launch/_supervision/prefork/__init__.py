# SPDX-License-Identifier: Apache-2.0
"""
Fork Python programs from a template process that has already imported their modules.

In the launch: `prefork` decides what to fork, and `template_handle` starts the template and
requests processes from it. In the template: `template` is its main program, `service` handles the
requests, `linux` clones it, and `starting_point` sets up a clone as if the program had been
executed.
"""
