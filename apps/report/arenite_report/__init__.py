# SPDX-License-Identifier: MIT
"""The report of one or several run folders: `arenite report DIR [DIR ...]`.

`__main__` reads the command line, `run_folder` what a folder holds, `numbers` derives what is compared, the `figures_*` draw
it, `pictures` and `render` make the 3-D pictures, `page` writes report.html. Needs numpy and matplotlib; PyVista for 3-D.
"""
