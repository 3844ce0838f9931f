#!/usr/bin/env csgrun
return cube(1)
