/* SPDX-License-Identifier: BSD-3-Clause */
/* The C99 interface of libmeniscus, which computes exact solvent-excluded surfaces of molecules from files or arrays.
 *
 *   meniscus_computer* computer = NULL;
 *   meniscus_surface* surface = NULL;
 *   meniscus_summary summary = {.size = sizeof summary};
 *   meniscus_atoms atoms = {.size = sizeof atoms, .count = count, .positions = xyz, .radii = radii};
 *   meniscus_options options = MENISCUS_OPTIONS_INIT;
 *   options.probe_radius = 1.5;
 *   if (meniscus_computer_new(&options, &computer) || meniscus_compute(computer, &atoms, &surface) ||
 *       meniscus_surface_summary(surface, &summary))
 *     fprintf(stderr, "%s\n", meniscus_last_error());
 *   else
 *     printf("%.2f A^2, %.2f A^3\n", summary.area, summary.volume);
 *   meniscus_surface_release(surface);
 *   meniscus_computer_release(computer);
 *
 * Units. Lengths are in angstrom (Å), areas in Å^2, volumes in Å^3, and angles in radian, except for the angle of a
 * camera, which is in degrees. Indices count from 0; the index MENISCUS_NONE means that there is none. Vectors are
 * three doubles, x, y, z. Texts are UTF-8 and end with a zero byte; paths are in the encoding of the system's file
 * names.
 *
 * Errors. A function that can fail returns a meniscus_status. After an error, meniscus_last_error() describes it in one
 * sentence, and the arguments for results are unchanged. Every such function can return MENISCUS_CAPACITY (out of
 * memory or threads) and MENISCUS_INTERNAL. The comments list the other errors after "Errors:". The library throws no
 * exception, raises no signal and prints nothing.
 *
 * Pointers. A function returns MENISCUS_USAGE if a pointer is NULL and its comment does not allow NULL, if a pointer is
 * not aligned as its type requires, and if an array does not fit into half the address space, as after a negative or
 * overflowing count. A pointer for a result may point to any value, which is overwritten and not released.
 *
 * Structs. A struct that is passed begins with its `size`, which the caller sets to sizeof; a function returns
 * MENISCUS_USAGE for an impossible size. For a caller compiled against an older header, the fields that it does not
 * know have their defaults. If a field of a newer header that this library does not know is not zero, a function
 * returns MENISCUS_USAGE. Enumerations have 32 bits in C and C++; a function returns MENISCUS_USAGE for a number that
 * is not one of the constants. Comments give defaults in brackets. A struct with defaults is initialized by its
 * MENISCUS_..._INIT or its meniscus_default_...() function, because zeros are not the defaults.
 *
 * Ownership. A function that creates an object returns one reference. _retain adds a reference and returns its
 * argument; _release removes one, and the last one frees the object; both allow NULL. The library reads arguments
 * during the call only and keeps no pointer to them. Tables and texts of an object are its own read-only memory, and
 * are valid until it is freed, or, for a surface, until meniscus_recompute() changes it. Texts that belong to no object
 * are never freed.
 *
 * Threads. Any number of threads may call all functions at once, also with the same objects. A computer and a renderer
 * execute one call after the other; all other objects execute calls at the same time. Only meniscus_recompute() changes
 * a surface; while it runs, no other thread may use that variable. After fork(), the child can go on with MENISCUS_CPU
 * if no other thread was in a call; calls that use GL return MENISCUS_NO_GPU there. */
#ifndef MENISCUS_MENISCUS_H
#define MENISCUS_MENISCUS_H

#if defined(__STDC_VERSION__) && __STDC_VERSION__ < 199901L
#error "meniscus.h needs C99 or C++"
#endif

#include <stddef.h>
#include <stdint.h>

/* The version of this header; meniscus_version() returns that of the library. */
#define MENISCUS_VERSION_MAJOR 0
#define MENISCUS_VERSION_MINOR 3
#define MENISCUS_VERSION_PATCH 0

#if defined(_WIN32) && defined(MENISCUS_BUILDS_LIBRARY)
#define MENISCUS_API __declspec(dllexport)
#elif defined(_WIN32)
#define MENISCUS_API __declspec(dllimport)
#elif defined(__GNUC__)
#define MENISCUS_API __attribute__((visibility("default")))
#else
#define MENISCUS_API
#endif

/* The type of enumerations in C++, where a caller may pass any number, too. */
#if defined(__cplusplus) && __cplusplus >= 201103L
#define MENISCUS_WORDS : int32_t
#else
#define MENISCUS_WORDS
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The index that means "none". */
#define MENISCUS_NONE UINT32_MAX

/* ---- Errors -------------------------------------------------------------------------------------------------- */

/* The result of a call. The numbers are the exit codes of the program, too. */
typedef enum meniscus_status {
  MENISCUS_OK = 0,
  MENISCUS_INTERNAL = 1,  /* a bug in this library; please report it */
  MENISCUS_USAGE = 2,     /* an invalid call: NULL, an unknown word, a struct without its size */
  MENISCUS_INPUT = 3,     /* an impossible number or file; the text has its place and value */
  MENISCUS_NO_GPU = 4,    /* no usable GL or GPU, or one that dropped work */
  MENISCUS_CAPACITY = 5,  /* out of memory or threads, or more items than an index can count */
  MENISCUS_OUTPUT = 6,    /* a file cannot be written, or it exists already */
  MENISCUS_NOT_CLOSED = 7 /* the surface would not be closed; the text names atoms */
} meniscus_status;

/* Returns the message of the last call of this thread that failed, as one sentence; "" if none has failed. The text is
 * valid until another call of this thread fails. */
MENISCUS_API const char* meniscus_last_error(void);

/* Returns the version of the loaded library, such as "0.3.0". */
MENISCUS_API const char* meniscus_version(void);

/* ---- Radii --------------------------------------------------------------------------------------------------- */

/* Finds the atomic number of an element.
 * symbol: "C", "zn", "CL", ... in upper or lower case; "D" and "T" are hydrogen.
 * *element: 1 to 118, or 0 if no element has this symbol. */
MENISCUS_API meniscus_status meniscus_element_of_symbol(const char* symbol, int32_t* element);

/* Finds the van der Waals radius of an element by Bondi (1964, 1966) or Mantina et al. (2009).
 * element: 0 (unknown) to 118.
 * *radius: Å; 2.0 for element 0 and for metals without a published value.
 * source: NULL, or receives the names of the authors, or "no published value".
 * Errors: MENISCUS_INPUT for other elements. */
MENISCUS_API meniscus_status meniscus_element_radius(int32_t element, double* radius, const char** source);

/* ---- Computing ----------------------------------------------------------------------------------------------- */

/* The kind of surface. */
typedef enum meniscus_kind MENISCUS_WORDS {
  MENISCUS_SES = 0, /* solvent-excluded: the boundary of the space that the probe cannot reach */
  MENISCUS_SAS = 1, /* solvent-accessible: the boundary of the positions of the probe's centre */
  MENISCUS_VDW = 2  /* van der Waals: the boundary of the union of the atoms, without a probe */
} meniscus_kind;

/* The device that computes surfaces or draws pictures. */
typedef enum meniscus_device MENISCUS_WORDS {
  MENISCUS_CPU = 0,     /* the CPU */
  MENISCUS_AUTO = 1,    /* a hardware GPU if one works, otherwise the CPU */
  MENISCUS_GPU = 2,     /* a hardware GPU; MENISCUS_NO_GPU if there is none */
  MENISCUS_SOFTWARE = 3 /* software GL, for tests of the code of GPUs */
} meniscus_device;

/* How surfaces are computed. */
typedef struct meniscus_options {
  size_t size;
  double probe_radius;    /* [1.4] Å, 0.001 to 100; not used for MENISCUS_VDW */
  meniscus_kind kind;     /* [MENISCUS_SES] */
  meniscus_device device; /* [MENISCUS_CPU] */
  int32_t threads;        /* [0] CPU threads, 1 to 4,096; 0: all of the machine */
  int32_t verify;         /* [0] 1: also compute on the other device and make a mesh; any difference is an error */
} meniscus_options;

/* Initializes a variable with the defaults. */
#define MENISCUS_OPTIONS_INIT \
  { sizeof(meniscus_options), 1.4, MENISCUS_SES, MENISCUS_CPU, 0, 0 }
/* Fills a struct with the defaults. The caller sets options->size first. */
MENISCUS_API meniscus_status meniscus_default_options(meniscus_options* options);

/* Computes surfaces. It keeps what several surfaces share: its options, and a GL context with kernels and buffers. */
typedef struct meniscus_computer meniscus_computer;

/* Creates a computer.
 * options: NULL for the defaults.
 * *computer: the new object, which the caller releases.
 * Errors: MENISCUS_INPUT for an impossible probe; MENISCUS_USAGE for other invalid options; MENISCUS_NO_GPU if the
 * device needs GL 4.5 and there is none. */
MENISCUS_API meniscus_status meniscus_computer_new(const meniscus_options* options, meniscus_computer** computer);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_computer* meniscus_computer_retain(meniscus_computer* computer);
MENISCUS_API void meniscus_computer_release(meniscus_computer* computer);

/* The type of the numbers in an array of the caller. */
typedef enum meniscus_number_type MENISCUS_WORDS { MENISCUS_DOUBLE = 0, MENISCUS_FLOAT = 1 } meniscus_number_type;

/* The atoms of a surface, as arrays of the caller. */
typedef struct meniscus_atoms {
  size_t size;
  size_t count;                        /* 1 to 2^27 atoms */
  const void* positions;               /* count rows of x, y, z in Å; finite, -100,000 to 100,000 */
  const void* radii;                   /* count van der Waals radii in Å; above 0, at most 1,000 */
  size_t positions_stride;             /* [0] bytes from one row to the next; 0: rows are contiguous */
  size_t radii_stride;                 /* [0] bytes from one radius to the next; 0: radii are contiguous */
  meniscus_number_type positions_type; /* [MENISCUS_DOUBLE] the type of the positions */
  meniscus_number_type radii_type;     /* [MENISCUS_DOUBLE] the type of the radii */
  int32_t equal_radii;                 /* [0] 1: all atoms have radii[0] */
  int32_t reserved;                    /* 0 */
} meniscus_atoms;

/* ---- Surfaces ------------------------------------------------------------------------------------------------ */

/* A closed surface: every border has two faces. It has passed its certificate, which checks the topology, the areas and
 * the volumes (see docs/explanation/theory.md). */
typedef struct meniscus_surface meniscus_surface;

/* Computes a surface.
 * *surface: the new object, which the caller releases.
 * Errors: MENISCUS_INPUT for no atoms and for a number outside of its range; MENISCUS_NOT_CLOSED if the surface would
 * not be closed; MENISCUS_NO_GPU if the GPU drops work. */
MENISCUS_API meniscus_status meniscus_compute(meniscus_computer* computer, const meniscus_atoms* atoms,
                                              meniscus_surface** surface);
/* Computes the surface of the next frame in place of another one.
 * *surface: before the call, an existing surface, whose reference the call takes over. If it is the only reference, the
 * object gets the new surface, and its tables are no longer valid; otherwise the reference is released, and *surface
 * becomes a new object.
 * Errors: those of meniscus_compute(). */
MENISCUS_API meniscus_status meniscus_recompute(meniscus_computer* computer, const meniscus_atoms* atoms,
                                                meniscus_surface** surface);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_surface* meniscus_surface_retain(meniscus_surface* surface);
MENISCUS_API void meniscus_surface_release(meniscus_surface* surface);

/* The numbers of a surface. */
typedef struct meniscus_summary {
  size_t size;
  double area;           /* Å^2, of all components */
  double volume;         /* Å^3, of the solid: of outer components without cavities */
  double probe_radius;   /* Å, of meniscus_options; 0 for MENISCUS_VDW */
  double grown_by;       /* Å; the largest amount by which radii were increased to resolve ties; usually 0 */
  uint64_t atoms;        /* atoms, both exposed and buried */
  uint64_t convex;       /* atoms with a contact patch */
  uint64_t toroidal;     /* saddle patches: edges of the reduced surface (RS), including free ones */
  uint64_t concave;      /* re-entrant patches: fixed probes with a part on the surface */
  uint64_t free_edges;   /* RS edges that are whole circles */
  uint64_t spindle;      /* saddle patches that cross their axis */
  uint64_t fixed_probes; /* RS faces; probes closer than 1e-6 Å count as one */
  uint64_t arcs;         /* RS edges with two ends */
  uint64_t faces;        /* connected pieces of patches */
  uint64_t borders;      /* arcs where two faces meet */
  uint64_t vertices;     /* ends of borders */
  uint64_t components;   /* closed, connected parts of the surface */
  uint64_t cavities;     /* components that enclose a space which the probe cannot leave */
  const char* device;  /* "cpu (16 threads)", with the threads of the machine, or the GL renderer and version; the text
                          belongs to the surface */
  double exact_within; /* Å; the surface is exact for radii that differ from the given ones by at most this; 0: for the
                          given radii */
} meniscus_summary;

/* Fills *summary. The caller sets summary->size first. */
MENISCUS_API meniscus_status meniscus_surface_summary(const meniscus_surface* surface, meniscus_summary* summary);

/* A table of an object. Row n begins at data + n * stride. The stride may be larger than the struct of a row, because
 * rows may grow in later versions. data may be NULL if count is 0. */
typedef struct meniscus_array {
  const void* data;
  size_t count;  /* the number of rows */
  size_t stride; /* bytes from one row to the next */
} meniscus_array;

/* The tables of a surface. Comments name the type of a row. */
typedef enum meniscus_surface_table_id MENISCUS_WORDS {
  MENISCUS_COMPONENTS = 0,     /* meniscus_component: outer ones, then cavities, each in order of descending area */
  MENISCUS_ATOM_AREAS = 1,     /* double per atom, Å^2: the area of the part of the surface whose nearest contact
                                  point is on the atom; 0 if the atom is buried; the sum is the area */
  MENISCUS_ATOM_SAS_AREAS = 2, /* double per atom, Å^2: the area of the solvent-accessible surface; for the kind
                                  MENISCUS_SES only */
  MENISCUS_ATOMS = 3,          /* meniscus_ball per atom; for MENISCUS_SAS, the radii include the probe's */
  MENISCUS_CONVEX = 4,         /* meniscus_convex */
  MENISCUS_TOROIDAL = 5,       /* meniscus_toroidal */
  MENISCUS_CONCAVE = 6,        /* meniscus_concave */
  MENISCUS_PLANES = 7,         /* meniscus_plane */
  MENISCUS_CONTACTS = 8,       /* uint32_t: an atom */
  MENISCUS_CUTS = 9,           /* uint32_t: a row of MENISCUS_CONCAVE */
  MENISCUS_VERTICES = 10,      /* double[3], Å */
  MENISCUS_BORDERS = 11,       /* meniscus_border */
  MENISCUS_HALF_BORDERS = 12,  /* uint32_t: 2 * border, plus 1 if the border is traversed backwards */
  MENISCUS_LOOPS = 13,         /* meniscus_loop */
  MENISCUS_FACES = 14          /* meniscus_face */
} meniscus_surface_table_id;

/* The kinds of patches and faces. */
typedef enum meniscus_patch_kind MENISCUS_WORDS {
  MENISCUS_KIND_CONVEX = 0,
  MENISCUS_KIND_TOROIDAL = 1,
  MENISCUS_KIND_CONCAVE = 2
} meniscus_patch_kind;
/* The kinds of borders. */
typedef enum meniscus_border_kind MENISCUS_WORDS {
  MENISCUS_BORDER_CONTACT = 0, /* between a contact patch and a saddle patch */
  MENISCUS_BORDER_EDGE = 1,    /* between a saddle patch and a re-entrant patch */
  MENISCUS_BORDER_CUSP = 2     /* between two re-entrant patches, where their probes intersect */
} meniscus_border_kind;
/* The kinds of components. */
typedef enum meniscus_component_kind MENISCUS_WORDS { MENISCUS_OUTER = 0, MENISCUS_CAVITY = 1 } meniscus_component_kind;

/* One closed, connected part of the surface. */
typedef struct meniscus_component {
  uint8_t kind;  /* MENISCUS_OUTER or MENISCUS_CAVITY */
  double area;   /* Å^2 */
  double volume; /* Å^3; negative for cavities, so that the sum is the volume of the solid */
  int32_t euler; /* the Euler characteristic: 2 minus twice the number of handles */
} meniscus_component;

/* A sphere of the computation. */
typedef struct meniscus_ball {
  double center[3]; /* Å */
  double radius;    /* Å */
} meniscus_ball;

/* A half-space: x is inside if dot(normal, x) <= offset. */
typedef struct meniscus_plane {
  double normal[3]; /* unit vector */
  double offset;    /* Å */
} meniscus_plane;

/* A contact patch: the part of an atom's sphere that is inside all its planes. */
typedef struct meniscus_convex {
  uint32_t atom;
  uint32_t first_plane, plane_count; /* rows of MENISCUS_PLANES */
  uint32_t first_face, face_count;   /* rows of MENISCUS_FACES: its connected pieces */
} meniscus_convex;

/* A saddle patch: the part of a torus along which a probe rolls over two atoms. The probe's centre moves
 * counter-clockwise about the axis, from center + radius * start by the angle sweep. The torus has the major radius
 * `radius` and the minor radius of the probe. If it intersects its axis (a spindle torus), the part beyond the axis is
 * removed, and a piece remains on either side. */
typedef struct meniscus_toroidal {
  uint32_t atom[2];  /* atom[0] < atom[1] */
  uint32_t probe[2]; /* rows of MENISCUS_CONCAVE at start and end; both MENISCUS_NONE for a whole circle */
  double center[3];  /* Å */
  double axis[3];    /* unit vector from atom[0] to atom[1] */
  double radius;     /* Å */
  double start[3];   /* unit vector */
  double sweep;      /* radian, in (0, 2 pi] */
  uint32_t first_face, face_count; /* rows of MENISCUS_FACES */
  uint8_t has_piece[2];            /* for a spindle torus: 1 if the piece at atom[n] exists */
} meniscus_toroidal;

/* A re-entrant patch: the part of a fixed probe's sphere that is inside all its planes. */
typedef struct meniscus_concave {
  double center[3];                      /* Å */
  uint32_t first_contact, contact_count; /* rows of MENISCUS_CONTACTS: the atoms that the probe touches, usually 3,
                                            counter-clockwise as seen from the probe */
  uint32_t first_plane;                  /* the first row of MENISCUS_PLANES: the side planes, the bisectors with */
  uint32_t side_count, cut_count, other_count; /* the probes in MENISCUS_CUTS, and other planes */
  uint32_t first_cut;                          /* the first of cut_count rows of MENISCUS_CUTS */
  uint32_t first_face, face_count;             /* rows of MENISCUS_FACES; 0 if other probes remove the whole patch */
} meniscus_concave;

/* An arc where two faces meet: center + radius * (cos t * start + sin t * cross(axis, start)), t in [0, sweep]. */
typedef struct meniscus_border {
  uint8_t kind;       /* MENISCUS_BORDER_... */
  double center[3];   /* Å */
  double axis[3];     /* unit vector */
  double radius;      /* Å */
  double start[3];    /* unit vector */
  double sweep;       /* radian */
  uint32_t vertex[2]; /* rows of MENISCUS_VERTICES at start and end; both MENISCUS_NONE for a whole circle */
  uint32_t face[2];   /* rows of MENISCUS_FACES to the left and to the right, as seen from the solvent */
} meniscus_border;

/* A closed chain of half-borders, with its face to the left as seen from the solvent. */
typedef struct meniscus_loop {
  uint32_t first_half_border, half_border_count; /* rows of MENISCUS_HALF_BORDERS */
} meniscus_loop;

/* A connected piece of a patch. */
typedef struct meniscus_face {
  uint8_t kind;                    /* MENISCUS_KIND_... */
  uint32_t patch;                  /* a row of the table of its kind */
  uint32_t first_loop, loop_count; /* rows of MENISCUS_LOOPS */
  uint32_t component;              /* a row of MENISCUS_COMPONENTS */
  uint32_t tip;                    /* for the face of a whole spindle torus, the vertex inside it, else MENISCUS_NONE */
  double area;                     /* Å^2 */
} meniscus_face;

/* Returns a table of a surface without a copy. The areas of atoms are computed by the first call that needs them, which
 * takes about a third of the time of the surface.
 * Errors: MENISCUS_USAGE for a table that the kind of surface does not have. */
MENISCUS_API meniscus_status meniscus_surface_table(const meniscus_surface* surface, meniscus_surface_table_id table,
                                                    meniscus_array* array);

/* Computes the Euclidean distance of points from the surface, in Å: above 0 in the solvent, below 0 in the solid. For
 * MENISCUS_SES, the solid is the space that no probe reaches, and cavities are solvent; for the other kinds, the solid
 * is the union of the balls. Distances are exact except for rounding, and within 1e-6 Å where atoms touch in one point.
 * points: count rows of x, y, z in Å, -1e150 to 1e150.
 * distances: count numbers.
 * nearest: NULL, or count rows of x, y, z in Å: a nearest point of the surface.
 * Errors: MENISCUS_INPUT for other coordinates; MENISCUS_USAGE if arrays overlap, unless nearest equals points. */
MENISCUS_API meniscus_status meniscus_surface_distance(const meniscus_surface* surface, size_t count,
                                                       const double* points, double* distances, double* nearest);

/* The quantities whose derivative meniscus_surface_gradient() computes. */
typedef enum meniscus_quantity MENISCUS_WORDS {
  MENISCUS_GRADIENT_AREA = 0,      /* the area of the surface */
  MENISCUS_GRADIENT_VOLUME = 1,    /* the volume of the solid */
  MENISCUS_GRADIENT_SAS_AREA = 2,  /* the sum of MENISCUS_ATOM_SAS_AREAS; for MENISCUS_SES only */
  MENISCUS_GRADIENT_SAS_VOLUME = 3 /* the volume in which the probe's centre cannot be; for MENISCUS_SES only */
} meniscus_quantity;

/* Computes the exact derivative of a quantity with respect to the position of each atom, in closed form.
 * weights: NULL, or one finite number per atom, by which the accessible area of the atom is multiplied, such as an
 * atomic solvation parameter. They are allowed for MENISCUS_GRADIENT_SAS_AREA of a MENISCUS_SES surface, and for
 * MENISCUS_GRADIENT_AREA of another kind.
 * gradient: three numbers per atom, Å^2/Å or Å^3/Å.
 * Errors: MENISCUS_USAGE for a quantity that the kind of surface does not have, and for weights that are not allowed;
 * MENISCUS_INPUT for a weight that is not finite, and if a probe touches more than three atoms at once: then the area
 * and the volume of a MENISCUS_SES surface are not differentiable. */
MENISCUS_API meniscus_status meniscus_surface_gradient(const meniscus_surface* surface, meniscus_quantity quantity,
                                                       const double* weights, double* gradient);

/* ---- Molecules from files ------------------------------------------------------------------------------------ */

/* Whether hydrogens are used. */
typedef enum meniscus_hydrogens MENISCUS_WORDS {
  MENISCUS_HYDROGENS_AUTO = 0, /* kept, unless the radii of heavy atoms include them */
  MENISCUS_HYDROGENS_KEEP = 1,
  MENISCUS_HYDROGENS_DROP = 2
} meniscus_hydrogens;

/* What happens to atoms of unknown element. */
typedef enum meniscus_unknown_element MENISCUS_WORDS {
  MENISCUS_UNKNOWN_HALT = 0,  /* the file is refused with MENISCUS_INPUT; the message names the atoms */
  MENISCUS_UNKNOWN_GUESS = 1, /* they have a radius of 2.0 Å */
  MENISCUS_UNKNOWN_SKIP = 2   /* they are not used */
} meniscus_unknown_element;

/* Which atoms of a file are used, and their radii. The defaults are those of the program. */
typedef struct meniscus_read_options {
  size_t size;
  const char* select;             /* [NULL: the polymers] a selection such as "chain A" or "all" (see `meniscus help
                                     selections`) */
  const char* assembly;           /* [NULL: as deposited] the biological assembly to build, such as "1" */
  const char* altloc;             /* ["best"] the alternate location of each residue: "best" (the most occupied one),
                                     "first", "all" or a letter */
  const char* radii;              /* [NULL: "file" if the file has radii, else "bondi"] the set of radii: "bondi",
                                     "united", "protor" or "file" */
  const char* const* radii_files; /* [NULL] paths of tables by residue and atom, which override the set; of two
                                     entries for an atom, the last one is used */
  const char* const* radius; /* [NULL] "EXPR=R": the radius R in Å of the atoms that EXPR selects; the last is used */
  size_t radii_file_count;   /* [0] the length of radii_files, at most 10,000 */
  size_t radius_count;       /* [0] the length of radius, at most 10,000 */
  int32_t model;             /* [1] the number of the model, from 1; 0: all models as one molecule */
  meniscus_hydrogens hydrogens;             /* [MENISCUS_HYDROGENS_AUTO] whether hydrogens are used */
  meniscus_unknown_element unknown_element; /* [MENISCUS_UNKNOWN_HALT] what happens to unknown elements */
  int32_t keep_water;                       /* [0] 1: water molecules are used, too */
  int32_t keep_ions;                        /* [0] 1: free ions are used, too */
  int32_t reserved;                         /* 0 */
} meniscus_read_options;

#define MENISCUS_READ_OPTIONS_INIT                                                                         \
  {                                                                                                        \
    sizeof(meniscus_read_options), NULL, NULL, "best", NULL, NULL, NULL, 0, 0, 1, MENISCUS_HYDROGENS_AUTO, \
        MENISCUS_UNKNOWN_HALT, 0, 0, 0                                                                     \
  }
/* Fills a struct with the defaults. The caller sets options->size first. */
MENISCUS_API meniscus_status meniscus_default_read_options(meniscus_read_options* options);

/* The atoms of a file from which a surface is computed. A structure never changes. */
typedef struct meniscus_structure meniscus_structure;

/* Reads a molecule from a PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ or XYZR file, which may be compressed
 * with gzip. By default it uses the polymers of the first model with the sugars that are bound to them, or all of a
 * file without a polymer, with the most occupied conformer of each residue, but neither water nor free ions. options:
 * NULL for the defaults. *structure: the new object, which the caller releases. Errors: MENISCUS_INPUT if the file
 * cannot be read, with its path and the line in the message; MENISCUS_USAGE for an invalid option. For an invalid
 * selection, the message has two more lines: the expression, and a caret below the error. */
MENISCUS_API meniscus_status meniscus_read(const char* path, const meniscus_read_options* options,
                                           meniscus_structure** structure);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_structure* meniscus_structure_retain(meniscus_structure* structure);
MENISCUS_API void meniscus_structure_release(meniscus_structure* structure);

/* Fills *atoms for meniscus_compute(), with arrays of the structure. The caller sets atoms->size first. */
MENISCUS_API meniscus_status meniscus_structure_atoms(const meniscus_structure* structure, meniscus_atoms* atoms);

/* What was read from a file. The texts belong to the structure. */
typedef struct meniscus_read_report {
  size_t size;
  const char* file;      /* the path that was passed */
  const char* format;    /* "PDB", "mmCIF", ... */
  const char* radii_set; /* the set of radii, or the files and overrides */
  const char* sentence;  /* "5,684 atoms read; 215 water atoms left out; 5,469 used" */
  uint64_t read;         /* atoms that were read, in all models and alternate locations */
  uint64_t atoms;        /* atoms of the structure, including the copies of an assembly */
  uint64_t models;       /* models in the file */
} meniscus_read_report;

/* Fills *report. The caller sets report->size first. */
MENISCUS_API meniscus_status meniscus_structure_report(const meniscus_structure* structure,
                                                       meniscus_read_report* report);

/* The tables of a structure. Each has one row per atom, except for warnings. Rows of text end with a zero byte and are
 * padded with zeros to the stride. They are copied from the file, so they may be other bytes than UTF-8. */
typedef enum meniscus_structure_table_id MENISCUS_WORDS {
  MENISCUS_STRUCTURE_POSITIONS = 0,       /* double[3], Å */
  MENISCUS_STRUCTURE_RADII = 1,           /* double, Å */
  MENISCUS_STRUCTURE_ELEMENTS = 2,        /* uint8_t: the atomic number; 0 if it is unknown */
  MENISCUS_STRUCTURE_INDICES = 3,         /* uint32_t: the index among all atoms that were read from the file, from 0 */
  MENISCUS_STRUCTURE_NAMES = 4,           /* text, such as "CA" */
  MENISCUS_STRUCTURE_RESIDUE_NAMES = 5,   /* text, such as "ALA" */
  MENISCUS_STRUCTURE_CHAINS = 6,          /* text, such as "A"; "A-2" in the second copy of an assembly */
  MENISCUS_STRUCTURE_SEGMENTS = 7,        /* text */
  MENISCUS_STRUCTURE_RESIDUE_NUMBERS = 8, /* int32_t: the number in the file */
  MENISCUS_STRUCTURE_INSERTION_CODES = 9, /* char; ' ' if there is none */
  MENISCUS_STRUCTURE_ALTLOCS = 10,        /* char; ' ' if there is none */
  MENISCUS_STRUCTURE_RESIDUES = 11,       /* uint32_t: the index of the residue in the file, from 0 */
  MENISCUS_STRUCTURE_MODELS = 12,         /* int32_t: the number of the model, from 1 */
  MENISCUS_STRUCTURE_COPIES = 13,         /* uint32_t: the index of the copy in an assembly, from 0 */
  MENISCUS_STRUCTURE_CHARGES = 14,        /* float, in e; NaN if the file has none */
  MENISCUS_STRUCTURE_B_FACTORS = 15,      /* float, Å^2; NaN if the file has none */
  MENISCUS_STRUCTURE_OCCUPANCIES = 16,    /* float, 0 to 1; NaN if the file has none */
  MENISCUS_STRUCTURE_CLASSES = 17,        /* uint8_t: 0 polymer, 1 ligand, 2 water, 3 ion, 4 unknown */
  MENISCUS_STRUCTURE_WARNINGS = 18,       /* text: one sentence per row about something unusual in the file */
  MENISCUS_STRUCTURE_HYDROPATHIES = 19 /* double, by residue (Kyte & Doolittle 1982); NaN for others than amino acids */
} meniscus_structure_table_id;

/* Returns a table of a structure without a copy. */
MENISCUS_API meniscus_status meniscus_structure_table(const meniscus_structure* structure,
                                                      meniscus_structure_table_id table, meniscus_array* array);

/* Computes the colours of the atoms by one of the program's schemes.
 * scheme: "chain", "bfactor" or another word of `meniscus colors` that colours atoms by data of the file, a name such
 * as "red", or "#rrggbb".
 * atom_colors: three numbers per atom, sRGB in [0, 1]; meniscus_render() takes them.
 * Errors: MENISCUS_USAGE for other schemes; MENISCUS_INPUT if no atom has the number that the scheme needs. */
MENISCUS_API meniscus_status meniscus_structure_colors(const meniscus_structure* structure, const char* scheme,
                                                       float* atom_colors);

/* ---- Pockets ------------------------------------------------------------------------------------------------- */

/* How pockets are found. */
typedef struct meniscus_pocket_options {
  size_t size;
  double large_probe_radius; /* [4] Å, above the probe's, at most 100; larger ones find wider, shallower pockets */
  double trim;               /* [1] Å, 0 to 100; pockets begin this far below the large probe's surface */
  double min_volume;         /* [30] Å^3, 0 to 1e9; smaller pockets are ignored */
  double mouth_tolerance;    /* [0.1] Å, 0.001 to 1; the largest error of the position of a mouth */
} meniscus_pocket_options;

#define MENISCUS_POCKET_OPTIONS_INIT \
  { sizeof(meniscus_pocket_options), 4.0, 1.0, 30.0, 0.1 }
/* Fills a struct with the defaults. The caller sets options->size first. */
MENISCUS_API meniscus_status meniscus_default_pocket_options(meniscus_pocket_options* options);

/* The pockets, tunnels and cavities of a surface: the connected spaces that its probe can fill inside the surface of a
 * large probe. Volumes and areas are computed in closed form, without a grid. Pockets never change. */
typedef struct meniscus_pockets meniscus_pockets;

/* Finds the pockets of a surface of the kind MENISCUS_SES on the CPU.
 * options: NULL for the defaults.
 * *pockets: the new object, which the caller releases. It does not need the surface any longer.
 * Errors: MENISCUS_USAGE for another kind of surface; MENISCUS_INPUT for a number outside of its range. */
MENISCUS_API meniscus_status meniscus_surface_pockets(const meniscus_surface* surface,
                                                      const meniscus_pocket_options* options,
                                                      meniscus_pockets** pockets);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_pockets* meniscus_pockets_retain(meniscus_pockets* pockets);
MENISCUS_API void meniscus_pockets_release(meniscus_pockets* pockets);

/* The tables of pockets. Comments name the type of a row. */
typedef enum meniscus_pockets_table_id MENISCUS_WORDS {
  MENISCUS_POCKETS = 0,       /* meniscus_pocket, in order of descending volume */
  MENISCUS_POCKET_MOUTHS = 1, /* double, Å^2: the area of a mouth; for each pocket in descending order */
  MENISCUS_POCKET_ATOMS = 2,  /* uint32_t: an atom that the probe can touch in a pocket; for each pocket ascending */
  MENISCUS_POCKET_PROBES = 3  /* double[3], Å: the centre of a fixed probe, which touches three atoms or more */
} meniscus_pockets_table_id;

/* A pocket, tunnel or cavity. */
typedef struct meniscus_pocket {
  double volume;        /* Å^3 */
  double volume_excess; /* Å^3; to first order, the volume is too large by at most this, because mouths lie
                           slightly outside */
  double area;          /* Å^2, of the whole boundary */
  double mouth_area;    /* Å^2, of all mouths; the rest of the boundary is wall */
  double depth;         /* Å, of the deepest fixed probe below the large probe's surface */
  double middle[3];     /* Å; the mean of the centres of fixed probes */
  uint32_t first_mouth, mouth_count; /* rows of MENISCUS_POCKET_MOUTHS; 0: a cavity, 1: a pocket, more: a tunnel */
  uint32_t first_atom, atom_count;   /* rows of MENISCUS_POCKET_ATOMS */
  uint32_t first_probe, probe_count; /* rows of MENISCUS_POCKET_PROBES */
} meniscus_pocket;

/* Returns a table of pockets without a copy. */
MENISCUS_API meniscus_status meniscus_pockets_table(const meniscus_pockets* pockets, meniscus_pockets_table_id table,
                                                    meniscus_array* array);

/* ---- Meshes -------------------------------------------------------------------------------------------------- */

/* How the triangles of a mesh are made. */
typedef enum meniscus_mesh_method MENISCUS_WORDS {
  MENISCUS_MESH_BY_PATCH = 0,  /* triangles within `tolerance`, which end at borders of patches */
  MENISCUS_MESH_EVEN = 1,      /* nearly equilateral triangles within `tolerance` */
  MENISCUS_MESH_BY_DENSITY = 2 /* nearly equilateral triangles with `density` */
} meniscus_mesh_method;

/* How a mesh is made. A number that the method does not use must have its default. */
typedef struct meniscus_mesh_options {
  size_t size;
  meniscus_mesh_method method; /* [MENISCUS_MESH_BY_PATCH] how triangles are made */
  int32_t split_colors; /* [1] 1: MENISCUS_MESH_BY_PATCH cuts triangles where the nearest contact point changes to
                           another atom, so that colours change along edges */
  double tolerance;     /* [0.01] Å, 0.00001 to 1; the largest distance of the mesh from the surface */
  double density;       /* [0] vertices per Å^2 of the exact area, 0.005 to 1,000, for MENISCUS_MESH_BY_DENSITY */
} meniscus_mesh_options;

#define MENISCUS_MESH_OPTIONS_INIT \
  { sizeof(meniscus_mesh_options), MENISCUS_MESH_BY_PATCH, 1, 0.01, 0.0 }
/* Fills a struct with the defaults. The caller sets options->size first. */
MENISCUS_API meniscus_status meniscus_default_mesh_options(meniscus_mesh_options* options);

/* A closed triangle mesh. All its vertices lie on the exact surface, of which the mesh has a reference. Triangles are
 * counter-clockwise as seen from the solvent. With MENISCUS_MESH_BY_PATCH, triangles end at the borders of patches,
 * however narrow these are. With the other methods, triangles cross borders, but not each other; the atom, kind, face
 * and patch of a triangle are those of the exact surface below its middle. A mesh never changes. */
typedef struct meniscus_mesh meniscus_mesh;

/* Makes a mesh of a surface.
 * options: NULL for the defaults.
 * *mesh: the new object, which the caller releases.
 * Errors: MENISCUS_INPUT for a number outside of its range, and if the surface has no mesh of this density;
 * MENISCUS_USAGE for other invalid options. */
MENISCUS_API meniscus_status meniscus_surface_mesh(const meniscus_surface* surface,
                                                   const meniscus_mesh_options* options, meniscus_mesh** mesh);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_mesh* meniscus_mesh_retain(meniscus_mesh* mesh);
MENISCUS_API void meniscus_mesh_release(meniscus_mesh* mesh);

/* The tables of a mesh. Comments name the type of a row. */
typedef enum meniscus_mesh_table_id MENISCUS_WORDS {
  MENISCUS_MESH_POSITIONS = 0,           /* double[3] per vertex, Å */
  MENISCUS_MESH_NORMALS = 1,             /* double[3] per vertex: the exact unit normal; at cusps the mean */
  MENISCUS_MESH_TRIANGLES = 2,           /* uint32_t[3] per triangle: its vertices */
  MENISCUS_MESH_TRIANGLE_ATOMS = 3,      /* uint32_t per triangle: the atom whose contact point is nearest */
  MENISCUS_MESH_TRIANGLE_KINDS = 4,      /* uint8_t per triangle: MENISCUS_KIND_... */
  MENISCUS_MESH_TRIANGLE_FACES = 5,      /* uint32_t per triangle: a row of MENISCUS_FACES */
  MENISCUS_MESH_TRIANGLE_PATCHES = 6,    /* uint32_t per triangle: a row of the table of its kind */
  MENISCUS_MESH_TRIANGLE_COMPONENTS = 7, /* uint32_t per triangle: a row of MENISCUS_COMPONENTS */
  MENISCUS_MESH_SHARP_CORNERS = 8,       /* uint32_t: a corner at a cusp, 3 * triangle + 0, 1 or 2; ascending */
  MENISCUS_MESH_SHARP_NORMALS = 9,       /* double[3] per sharp corner: its exact unit normal */
  MENISCUS_MESH_VERTEX_ATOMS = 10        /* uint32_t per vertex: the atom whose contact point is nearest; the first one
                                            if several are equally near */
} meniscus_mesh_table_id;

/* Returns a table of a mesh without a copy. */
MENISCUS_API meniscus_status meniscus_mesh_table(const meniscus_mesh* mesh, meniscus_mesh_table_id table,
                                                 meniscus_array* array);

/* How a mesh is written to a file. */
typedef struct meniscus_mesh_file {
  size_t size;
  const char* format;       /* [NULL: by the extension of the path] "stl", "3mf", "obj", "off", "glb", "vtp", "smesh",
                               "dms", "ply", "ply-ascii", "py", "usda" or "usdz" */
  const char* attributes;   /* ["usual"] numbers of vertices in GLB, PLY, VTP and USD files, separated by commas:
                               "vdw_radii", "atom_index", "ses_kind", "ses_component" (these four are "usual"),
                               "mean_curvature", "gaussian_curvature", "smooth_mean_curvature",
                               "smooth_gaussian_curvature", "atom_area", "accessible_area", "patch_area",
                               "open_sky", "atom_open_sky"; "all" (but the last two), or "none" */
  const float* atom_colors; /* [NULL: all atoms have `color`] three numbers per atom, sRGB in [0, 1] */
  double scale;             /* [1] the length of 1 Å in the file, 1e-12 to 1e6: in mm in 3MF, in m in GLB; not used in
                               DMS, which is in Å */
  float color[3];           /* [0.75, 0.82, 0.9] the colour of all atoms, sRGB in [0, 1] */
  int32_t replace;          /* [0] 1: an existing file is replaced */
} meniscus_mesh_file;

#define MENISCUS_MESH_FILE_INIT \
  { sizeof(meniscus_mesh_file), NULL, "usual", NULL, 1.0, {0.75f, 0.82f, 0.9f}, 0 }
/* Fills a struct with the defaults. The caller sets file->size first. */
MENISCUS_API meniscus_status meniscus_default_mesh_file(meniscus_mesh_file* file);

/* Writes a mesh to a file, completely or not at all. In the file, edges shorter than 0.001 Å and triangles without area
 * in single precision are welded; the mesh is not changed.
 * file: NULL for the defaults.
 * Errors: MENISCUS_OUTPUT if the file cannot be written, or exists and is not replaced; MENISCUS_USAGE for an unknown
 * format or attribute; MENISCUS_INPUT for a number outside of its range; MENISCUS_NOT_CLOSED if "smesh" finds no point
 * inside a component. */
MENISCUS_API meniscus_status meniscus_mesh_save(const meniscus_mesh* mesh, const char* path,
                                                const meniscus_mesh_file* file);

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

/* The projection of a camera. */
typedef enum meniscus_projection MENISCUS_WORDS {
  MENISCUS_PERSPECTIVE = 0,
  MENISCUS_ORTHOGRAPHIC = 1
} meniscus_projection;

/* A camera. */
typedef struct meniscus_camera {
  size_t size;
  double position[3], target[3];  /* Å; different points */
  double up[3];                   /* a direction that is not parallel to the view */
  double vertical_fov;            /* degrees between the lower and the upper edge of the picture; perspective only */
  double height;                  /* Å between the lower and the upper edge of the picture; orthographic only */
  meniscus_projection projection; /* the projection */
  int32_t reserved;               /* 0 */
} meniscus_camera;

/* Finds the camera that shows all atoms, with their widest side across the picture.
 * aspect: width / height of the picture.
 * *camera: the caller sets camera->size first.
 * Errors: MENISCUS_INPUT for an aspect of which there is no picture. */
MENISCUS_API meniscus_status meniscus_surface_camera(const meniscus_surface* surface, double aspect,
                                                     meniscus_projection projection, meniscus_camera* camera);

/* All settings of a picture: the file of the molecule and its atoms, the surface and its colours, other shapes, the
 * view, the look and the annotations. A new scene has the defaults of the program. Each property has a name, which is
 * that of the program's option with "_" for "-" ("depth_cue"), and a key, which is that of scene files
 * ("look.depth_cue"); meniscus_scene_properties() lists all. Values are texts as on the command line, with the same
 * units: "7pt", "0.5", "chain A"; flags are "true" or "false". */
typedef struct meniscus_scene meniscus_scene;

/* Creates a scene with the defaults.
 * *scene: the new object, which the caller releases. */
MENISCUS_API meniscus_status meniscus_scene_new(meniscus_scene** scene);
/* Reads a scene file of the program. Paths in the file are relative to its folder and must not lead out of it, because
 * a scene may come from anyone.
 * *scene: the new object, which the caller releases.
 * Errors: MENISCUS_INPUT for an invalid file, with its path and the line or the key in the message. */
MENISCUS_API meniscus_status meniscus_scene_read(const char* path, meniscus_scene** scene);
/* Reads the text of a scene file. Paths are relative to the working directory and may lead anywhere.
 * *scene: the new object, which the caller releases.
 * Errors: MENISCUS_INPUT for an invalid text, with the line or the key in the message. */
MENISCUS_API meniscus_status meniscus_scene_parse(const char* json, meniscus_scene** scene);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_scene* meniscus_scene_retain(meniscus_scene* scene);
MENISCUS_API void meniscus_scene_release(meniscus_scene* scene);

/* Sets the value of a property, or adds a value to a repeatable property.
 * name: the name or the key of the property.
 * value: the text of the value. NULL restores the default and removes all added values.
 * Errors: MENISCUS_USAGE for an unknown name or an invalid value. The message begins with the name; for an invalid
 * selection it has two more lines, as for meniscus_read(). */
MENISCUS_API meniscus_status meniscus_scene_set(meniscus_scene* scene, const char* name, const char* value);
/* Returns the value of a property.
 * name: the name or the key of the property.
 * n: 0, or the index of a value of a repeatable property.
 * *value: a text that belongs to the scene; NULL if the property has its default, or at most n values.
 * Errors: MENISCUS_USAGE for an unknown name. */
MENISCUS_API meniscus_status meniscus_scene_get(const meniscus_scene* scene, const char* name, size_t n,
                                                const char** value);
/* Returns the scene as the text of a scene file, without the properties that have their defaults.
 * folder: paths in the text are relative to this folder; NULL: to the working directory.
 * *json: a text that belongs to the scene.
 * Errors: MENISCUS_USAGE for values that contradict each other. */
MENISCUS_API meniscus_status meniscus_scene_json(const meniscus_scene* scene, const char* folder, const char** json);
/* Returns the size of the picture in pixels.
 * Errors: MENISCUS_USAGE for values that contradict each other. */
MENISCUS_API meniscus_status meniscus_scene_size(const meniscus_scene* scene, int32_t* width, int32_t* height);

/* The type of the values of a property. */
typedef enum meniscus_value_type MENISCUS_WORDS {
  MENISCUS_VALUE_FLAG = 0,     /* "true" or "false" */
  MENISCUS_VALUE_NUMBER = 1,   /* a real number */
  MENISCUS_VALUE_COUNT = 2,    /* a whole number */
  MENISCUS_VALUE_WORD = 3,     /* one of `words` */
  MENISCUS_VALUE_TEXT = 4,     /* a text with its own syntax: a selection, a colour, a length such as "0.5pt" */
  MENISCUS_VALUE_FILE = 5,     /* the path of a file that is read */
  MENISCUS_VALUE_NEW_FILE = 6, /* the path of a file that the program writes; this library ignores it */
  MENISCUS_VALUE_CAMERA = 7    /* a camera as JSON, or the path of a file with a camera */
} meniscus_value_type;

/* A property of scenes. The texts are never freed; a text that does not exist is "". */
typedef struct meniscus_property {
  const char* name;         /* such as "depth_cue" */
  const char* key;          /* such as "look.depth_cue" */
  const char* value;        /* the placeholder for the value in the help, such as "WIDTH"; "" for flags */
  const char* help;         /* the sentence of the help */
  const char* words;        /* "ses|sas|vdw": all values of a MENISCUS_VALUE_WORD, or usual values of another type */
  const char* initial;      /* the default in the help */
  double lowest, highest;   /* the range of numbers, counts and lengths in pixels; equal: any number */
  meniscus_value_type type; /* the type of the values */
  int32_t repeatable;       /* 1: the property may have several values */
  int32_t of_surface;       /* 1: meniscus_render() uses the property, too */
  int32_t reserved;         /* 0 */
} meniscus_property;

/* Returns a table of all properties, rows of meniscus_property, in the order of the help. It is valid until the process
 * ends. */
MENISCUS_API meniscus_status meniscus_scene_properties(meniscus_array* array);

/* Draws pictures. A renderer on GL has its own context and thread, and does not change contexts of the caller. */
typedef struct meniscus_renderer meniscus_renderer;

/* Creates a renderer.
 * device: with MENISCUS_CPU, pictures are bitwise equal for any vector width and number of threads.
 * *renderer: the new object, which the caller releases.
 * Errors: MENISCUS_NO_GPU if the device needs GL 4.5 and there is none. */
MENISCUS_API meniscus_status meniscus_renderer_new(meniscus_device device, meniscus_renderer** renderer);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_renderer* meniscus_renderer_retain(meniscus_renderer* renderer);
MENISCUS_API void meniscus_renderer_release(meniscus_renderer* renderer);

/* Draws a scene. The bytes are those of `meniscus render`: the function reads the molecule, computes the surface and
 * the other shapes, and draws the legend, labels and scale bar. It uses the device of the renderer, and does not write
 * the `output` and `legend_file` of the scene.
 * rgba: width * height * 4 bytes of meniscus_scene_size(): rows from the top of red, green, blue and alpha, which is
 * not premultiplied.
 * rgba_size: the size of rgba in bytes.
 * Errors: those of meniscus_read(), meniscus_compute() and meniscus_scene_set(); MENISCUS_USAGE if rgba is too small,
 * and for a scene with several frames. */
MENISCUS_API meniscus_status meniscus_render_scene(meniscus_renderer* renderer, const meniscus_scene* scene,
                                                   uint8_t* rgba, size_t rgba_size);

/* Draws a computed surface.
 * scene: NULL for the defaults. A scene may set the properties of the look and of the image ("look." and "image." in
 * keys), `projection`, and one `color`.
 * camera: NULL for the camera of meniscus_surface_camera().
 * atom_colors: NULL for the `color` of the scene, or three numbers per atom, sRGB in [0, 1].
 * rgba, rgba_size: as for meniscus_render_scene().
 * Errors: MENISCUS_USAGE if the scene sets other properties, or rgba is too small; MENISCUS_INPUT for an impossible
 * camera or colour; MENISCUS_NO_GPU if the GPU drops work. */
MENISCUS_API meniscus_status meniscus_render(meniscus_renderer* renderer, const meniscus_surface* surface,
                                             const meniscus_scene* scene, const meniscus_camera* camera,
                                             const float* atom_colors, uint8_t* rgba, size_t rgba_size);

/* ---- Pages --------------------------------------------------------------------------------------------------- */

/* A web page of one file, in which a reader can rotate the exact surface. It loads nothing else, and draws the patches
 * by ray casting with WebGL 2; browsers without WebGL 2 show a picture. Readers choose colours, views, chains and a
 * cut, and save PNG files (see docs/how-to/pages.md). A page never changes. */
typedef struct meniscus_page meniscus_page;

/* Makes the page of a scene, like `meniscus export page`. It reads the molecule, and computes the surface and the other
 * shapes on the CPU. The `output`, legend, title and scale bar of the scene are not used.
 * *page: the new object, which the caller releases.
 * Errors: those of meniscus_render_scene(); MENISCUS_USAGE also for properties that pages do not show, such as
 * `object`. */
MENISCUS_API meniscus_status meniscus_scene_page(const meniscus_scene* scene, meniscus_page** page);

/* Makes the page of a computed surface.
 * structure: NULL, or the structure of the surface's atoms, in the same order: then the page shows the names of atoms,
 * and its readers can choose colour schemes.
 * scene, camera, atom_colors: as for meniscus_render().
 * *page: the new object, which the caller releases.
 * Errors: those of meniscus_render(); MENISCUS_USAGE also if the structure has another number of atoms. */
MENISCUS_API meniscus_status meniscus_surface_page(const meniscus_surface* surface, const meniscus_structure* structure,
                                                   const meniscus_scene* scene, const meniscus_camera* camera,
                                                   const float* atom_colors, meniscus_page** page);
/* Add and remove a reference (see Ownership above). */
MENISCUS_API meniscus_page* meniscus_page_retain(meniscus_page* page);
MENISCUS_API void meniscus_page_release(meniscus_page* page);

/* Returns the text of a page.
 * *html: a text that belongs to the page.
 * size: NULL, or receives the number of bytes without the zero byte at the end. */
MENISCUS_API meniscus_status meniscus_page_html(const meniscus_page* page, const char** html, size_t* size);

#ifdef __cplusplus
}
#endif

#endif
