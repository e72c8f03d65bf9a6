"""The release gate: everything that must hold before a release, run, recorded, compared with the previous release."""
