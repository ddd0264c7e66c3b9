# One particle that spins about the y axis and flies downwards, without gravity.

atom_style      granular
atom_modify     map array sort 0 0
boundary        f f f
newton          off
communicate     single vel yes
units           si

region          domain block -${halfWidth} ${halfWidth} -${halfWidth} ${halfWidth} 0 ${height} units box
create_box      1 domain
variable        skin equal 0.3*${particleDiameter}
neighbor        ${skin} bin
neigh_modify    delay 0

fix young       all property/global youngsModulus peratomtype 5e6
fix poisson     all property/global poissonsRatio peratomtype 0.2
fix restitution all property/global coefficientRestitution peratomtypepair 1 0.9
fix friction    all property/global coefficientFriction peratomtypepair 1 0.1
pair_style      gran model hertz tangential history
pair_coeff      * *
timestep        ${demStep}

create_atoms    1 single ${releaseX} ${releaseY} ${releaseHeight} units box
set             group all diameter ${particleDiameter} density ${particleDensity}
set             group all omegay ${spin}
velocity        all set 0 0 -${releaseSpeed} units box
fix motion      all nve/sphere

dump            spin all custom ${dumpEvery} DEM/spin.dump id x y z vx vy vz omegax omegay omegaz
dump_modify     spin first yes format "%d %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g %.15g"
