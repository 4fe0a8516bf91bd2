/* SPDX-License-Identifier: BSD-3-Clause */
/* Exact solvent-excluded surfaces of molecules for other programs, in C99: files or arrays in, arrays out.
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
 * Units. Lengths are in angstrom (Å), areas in Å^2, volumes in Å^3, angles in radian (a camera's in degrees). Indices
 * count from 0; MENISCUS_NONE stands for none. Vectors are three doubles, x, y, z.
 *
 * Errors. A function that can fail returns a meniscus_status. After an error meniscus_last_error() describes it in one
 * sentence, and output arguments are unchanged. The library throws no exception, raises no signal and prints nothing.
 *
 * Arrays. Each pointer is aligned as its type is. An array that does not fit into half the address space, as after a
 * negative number or an overflow, is MENISCUS_USAGE.
 *
 * Structs that are passed begin with their `size`: set it to sizeof. For a caller compiled against an older header,
 * fields that it does not know have their defaults; fields of a newer header that this library does not know are
 * refused if they are set. A struct whose fields have defaults, in brackets below, begins as its MENISCUS_..._INIT or
 * as its meniscus_default_...() fills it in: zeros are not the defaults.
 *
 * Ownership. Objects begin with one reference. _retain adds one, _release removes one (NULL is allowed), and the last
 * frees the object. Arrays that are passed in are read during the call only. Arrays of a surface or a mesh are its own
 * memory, read-only, and live as long as it does; a surface that is computed again in place (meniscus_recompute) has
 * new ones.
 *
 * Threads. All functions may be called from any number of threads at once, also with the same objects: a computer and a
 * renderer serve one call after the other; scenes, surfaces and meshes serve all at once. Only meniscus_recompute
 * changes a surface: while it runs, no other thread may use that variable. After fork() the child can continue with
 * MENISCUS_CPU if no other thread was in a call; calls that use GL are refused there. */
#ifndef MENISCUS_MENISCUS_H
#define MENISCUS_MENISCUS_H

#if defined(__STDC_VERSION__) && __STDC_VERSION__ < 199901L
#error "meniscus.h needs C99 or C++"
#endif

#include <stddef.h>
#include <stdint.h>

/* The version of this header; meniscus_version() returns that of the library. */
#define MENISCUS_VERSION_MAJOR 0
#define MENISCUS_VERSION_MINOR 2
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

/* Each enumeration is a type of 32 bits, so that a caller may also pass other numbers, which are refused. */
#if defined(__cplusplus) && __cplusplus >= 201103L
#define MENISCUS_WORDS : int32_t
#else
#define MENISCUS_WORDS
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define MENISCUS_NONE UINT32_MAX

/* ---- Errors -------------------------------------------------------------------------------------------------- */

/* The numbers are those of the program's exit codes. */
typedef enum meniscus_status {
  MENISCUS_OK = 0,
  MENISCUS_INTERNAL = 1,  /* a fault of this library: please report it */
  MENISCUS_USAGE = 2,     /* a call that is not valid: NULL, an unknown word, a struct without its size */
  MENISCUS_INPUT = 3,     /* an impossible position, radius, colour or camera; the text has its index and value */
  MENISCUS_NO_GPU = 4,    /* no usable GL or GPU, or one that dropped work */
  MENISCUS_CAPACITY = 5,  /* out of memory or threads, or more than indices or a file can count */
  MENISCUS_OUTPUT = 6,    /* a file cannot be written, or exists already */
  MENISCUS_NOT_CLOSED = 7 /* the surface or mesh is not closed, so there is none; the text names atoms */
} meniscus_status;

/* The error of the last call of this thread that failed, as one sentence in UTF-8; "" if none has. It stays until
 * another call of this thread fails. */
MENISCUS_API const char* meniscus_last_error(void);

/* "0.2.0". */
MENISCUS_API const char* meniscus_version(void);

/* ---- Radii --------------------------------------------------------------------------------------------------- */

/* The atomic number of "C", "zn", "CL", ... in any case, D and T as hydrogen; 0: no element has this symbol. */
MENISCUS_API meniscus_status meniscus_element_of_symbol(const char* symbol, int32_t* element);

/* The van der Waals radius by Bondi (1964, 1966) or Mantina et al. (2009). source may be NULL; else it is set to their
 * names, or to "no published value" for element 0 and for metals that neither has; the radius is 2.0 then. Refuses
 * elements below 0 and above 118. */
MENISCUS_API meniscus_status meniscus_element_radius(int32_t element, double* radius, const char** source);

/* ---- Computing ----------------------------------------------------------------------------------------------- */

/* meniscus_options.kind: which surface. */
typedef enum meniscus_kind MENISCUS_WORDS {
  MENISCUS_SES = 0, /* solvent-excluded: what the probe cannot reach */
  MENISCUS_SAS = 1, /* solvent-accessible: where the probe's centre can be */
  MENISCUS_VDW = 2  /* van der Waals: the balls themselves, without a probe */
} meniscus_kind;

/* Where surfaces are computed, and pictures drawn. */
typedef enum meniscus_device MENISCUS_WORDS {
  MENISCUS_CPU = 0,     /* on the CPU */
  MENISCUS_AUTO = 1,    /* on a hardware GPU if one works, else as MENISCUS_CPU */
  MENISCUS_GPU = 2,     /* on a hardware GPU only */
  MENISCUS_SOFTWARE = 3 /* by software GL only, for tests of the GPU's code */
} meniscus_device;

typedef struct meniscus_options {
  size_t size;
  double probe_radius;    /* [1.4] 0.001 to 100; ignored by MENISCUS_VDW, which alone has no probe */
  meniscus_kind kind;     /* [MENISCUS_SES] */
  meniscus_device device; /* [MENISCUS_CPU] */
  int32_t threads;        /* [0: all] CPU threads, the calling one included */
  int32_t verify;         /* [0] else: also compute on the other device and mesh; every difference is an error */
} meniscus_options;

/* The defaults, to begin a variable with. */
#define MENISCUS_OPTIONS_INIT \
  { sizeof(meniscus_options), 1.4, MENISCUS_SES, MENISCUS_CPU, 0, 0 }
/* Fills in the defaults, as in brackets. options->size has to be set. */
MENISCUS_API meniscus_status meniscus_default_options(meniscus_options* options);

/* What is kept from frame to frame: a GL context, its kernels and buffers. */
typedef struct meniscus_computer meniscus_computer;

/* options: NULL for the defaults. *computer is overwritten. */
MENISCUS_API meniscus_status meniscus_computer_new(const meniscus_options* options, meniscus_computer** computer);
MENISCUS_API meniscus_computer* meniscus_computer_retain(meniscus_computer* computer);
MENISCUS_API void meniscus_computer_release(meniscus_computer* computer);

typedef enum meniscus_number_type MENISCUS_WORDS { MENISCUS_DOUBLE = 0, MENISCUS_FLOAT = 1 } meniscus_number_type;

typedef struct meniscus_atoms {
  size_t size;
  size_t count;                        /* at least 1 */
  const void* positions;               /* x, y, z of each atom, next to each other; finite, within 100,000 Å of 0 */
  const void* radii;                   /* van der Waals radius of each atom, above 0, at most 1,000 */
  size_t positions_stride;             /* bytes from one atom to the next; [0: without a gap] */
  size_t radii_stride;                 /* likewise */
  meniscus_number_type positions_type; /* [MENISCUS_DOUBLE] or MENISCUS_FLOAT, aligned as such */
  meniscus_number_type radii_type;     /* likewise */
  int32_t equal_radii;                 /* [0] else: all atoms have radii[0] */
  int32_t reserved;                    /* 0 */
} meniscus_atoms;

/* ---- Surfaces ------------------------------------------------------------------------------------------------ */

/* A closed surface with its certificate: every border has two faces, areas and volumes are proved (see
 * docs/explanation/theory.md).
 */
typedef struct meniscus_surface meniscus_surface;

/* Computes one surface. *surface is overwritten. */
MENISCUS_API meniscus_status meniscus_compute(meniscus_computer* computer, const meniscus_atoms* atoms,
                                              meniscus_surface** surface);
/* Computes the next frame. *surface is a surface, such as that of the previous frame, and the call takes over its
 * reference. If it is the only reference, the surface is computed again in place, and its arrays end; otherwise it is
 * released and a new one is made. If the call fails, *surface is unchanged. */
MENISCUS_API meniscus_status meniscus_recompute(meniscus_computer* computer, const meniscus_atoms* atoms,
                                                meniscus_surface** surface);
MENISCUS_API meniscus_surface* meniscus_surface_retain(meniscus_surface* surface);
MENISCUS_API void meniscus_surface_release(meniscus_surface* surface);

typedef struct meniscus_summary {
  size_t size;
  double area;           /* Å^2, of all components */
  double volume;         /* Å^3 of the solid: outer components less cavities */
  double probe_radius;   /* that of meniscus_options; 0 for MENISCUS_VDW */
  double grown_by;       /* Å by which radii were grown at most to resolve ties; usually 0 */
  uint64_t atoms;        /* given, exposed or not */
  uint64_t convex;       /* atoms with a contact patch */
  uint64_t toroidal;     /* saddle patches: RS edges, free ones included */
  uint64_t concave;      /* re-entrant patches: fixed probes of which a part is on the surface */
  uint64_t free_edges;   /* whole circles */
  uint64_t spindle;      /* saddle patches that cross their axis */
  uint64_t fixed_probes; /* RS faces; probes closer than 1e-6 Å count as one */
  uint64_t arcs;         /* RS edges with two ends */
  uint64_t faces;        /* connected pieces of patches */
  uint64_t borders;
  uint64_t vertices;
  uint64_t components;
  uint64_t cavities;   /* components that the probe cannot get out of */
  const char* device;  /* "cpu (16 threads)", the threads of the machine, or GL renderer and version; lives as long as
                          the surface */
  double exact_within; /* Å: the surface is exact for radii that differ from the given ones by so much at most; 0: for
                          the given ones */
} meniscus_summary;

/* summary->size has to be set. */
MENISCUS_API meniscus_status meniscus_surface_summary(const meniscus_surface* surface, meniscus_summary* summary);

/* Rows one after another: row n begins at data + n * stride. The stride may be larger than the struct below, because
 * rows may grow in later versions. data may be NULL where count is 0. */
typedef struct meniscus_array {
  const void* data;
  size_t count;
  size_t stride;
} meniscus_array;

/* The tables of a surface, and what their rows are. */
typedef enum meniscus_surface_table_id MENISCUS_WORDS {
  MENISCUS_COMPONENTS = 0,     /* meniscus_component: outer ones first, then cavities, each by falling area */
  MENISCUS_ATOM_AREAS = 1,     /* double per atom, Å^2, 0 where buried: the part of the surface whose nearest contact
                                  is with the atom; the sum is the area */
  MENISCUS_ATOM_SAS_AREAS = 2, /* double per atom, Å^2: where the probe's centre can be; of MENISCUS_SES only */
  MENISCUS_ATOMS = 3,          /* meniscus_ball per atom: what was computed, radii with the probe for MENISCUS_SAS */
  MENISCUS_CONVEX = 4,         /* meniscus_convex */
  MENISCUS_TOROIDAL = 5,       /* meniscus_toroidal */
  MENISCUS_CONCAVE = 6,        /* meniscus_concave */
  MENISCUS_PLANES = 7,         /* meniscus_plane */
  MENISCUS_CONTACTS = 8,       /* uint32_t: atoms */
  MENISCUS_CUTS = 9,           /* uint32_t: rows of MENISCUS_CONCAVE */
  MENISCUS_VERTICES = 10,      /* double[3] */
  MENISCUS_BORDERS = 11,       /* meniscus_border */
  MENISCUS_HALF_BORDERS = 12,  /* uint32_t: 2 * border, and 1 more if walked backwards */
  MENISCUS_LOOPS = 13,         /* meniscus_loop */
  MENISCUS_FACES = 14          /* meniscus_face */
} meniscus_surface_table_id;

typedef enum meniscus_patch_kind MENISCUS_WORDS {
  MENISCUS_KIND_CONVEX = 0,
  MENISCUS_KIND_TOROIDAL = 1,
  MENISCUS_KIND_CONCAVE = 2
} meniscus_patch_kind;
typedef enum meniscus_border_kind MENISCUS_WORDS {
  MENISCUS_BORDER_CONTACT = 0,
  MENISCUS_BORDER_EDGE = 1,
  MENISCUS_BORDER_CUSP = 2
} meniscus_border_kind;
typedef enum meniscus_component_kind MENISCUS_WORDS { MENISCUS_OUTER = 0, MENISCUS_CAVITY = 1 } meniscus_component_kind;

/* One closed, connected part of the surface. */
typedef struct meniscus_component {
  uint8_t kind;  /* MENISCUS_OUTER or MENISCUS_CAVITY */
  double area;   /* Å^2 */
  double volume; /* Å^3, signed: negative for cavities, so that the sum is the solid's; a cavity's volume is -volume */
  int32_t euler; /* Euler characteristic: 2 less twice the handles */
} meniscus_component;

typedef struct meniscus_ball {
  double center[3];
  double radius;
} meniscus_ball;

/* A half-space: x is inside where dot(normal, x) <= offset. */
typedef struct meniscus_plane {
  double normal[3]; /* unit */
  double offset;
} meniscus_plane;

/* Contact patch: the sphere of one atom inside all its planes. */
typedef struct meniscus_convex {
  uint32_t atom;
  uint32_t first_plane, plane_count;
  uint32_t first_face, face_count; /* its connected pieces */
} meniscus_convex;

/* Saddle patch: a probe rolls about two atoms, its centre counter-clockwise about the axis from center + radius * start
 * by the angle sweep. The torus' major radius is `radius`, its minor one the probe's. Where it crosses its axis
 * (spindle), the part past the axis is cut off, and a piece on either side remains. */
typedef struct meniscus_toroidal {
  uint32_t atom[2];  /* atom[0] < atom[1] */
  uint32_t probe[2]; /* rows of MENISCUS_CONCAVE at start and end; MENISCUS_NONE twice for a whole circle */
  double center[3];
  double axis[3]; /* unit, from atom[0] to atom[1] */
  double radius;
  double start[3]; /* unit */
  double sweep;    /* in (0, 2 pi] */
  uint32_t first_face, face_count;
  uint8_t has_piece[2]; /* of a spindle */
} meniscus_toroidal;

/* Re-entrant patch: the sphere of one fixed probe inside all its planes. */
typedef struct meniscus_concave {
  double center[3];
  uint32_t first_contact, contact_count; /* touched atoms, counter-clockwise seen from the probe; usually 3 */
  uint32_t first_plane;                  /* side planes, then bisectors with the probes in cuts, then others */
  uint32_t side_count, cut_count, other_count;
  uint32_t first_cut;
  uint32_t first_face, face_count; /* 0 where other probes cut everything away */
} meniscus_concave;

/* An arc of a circle, center + radius * (cos t * start + sin t * cross(axis, start)), t in [0, sweep], where two faces
 * meet. */
typedef struct meniscus_border {
  uint8_t kind; /* MENISCUS_BORDER_... */
  double center[3];
  double axis[3]; /* unit */
  double radius;
  double start[3]; /* unit */
  double sweep;
  uint32_t vertex[2]; /* at start and end; MENISCUS_NONE twice for a whole circle */
  uint32_t face[2];   /* left and right of it, seen from the solvent */
} meniscus_border;

/* A closed chain of half-borders with its face on the left, seen from the solvent. */
typedef struct meniscus_loop {
  uint32_t first_half_border, half_border_count;
} meniscus_loop;

/* A connected piece of a patch. */
typedef struct meniscus_face {
  uint8_t kind;   /* MENISCUS_KIND_... */
  uint32_t patch; /* row of the table of its kind */
  uint32_t first_loop, loop_count;
  uint32_t component;
  uint32_t tip; /* vertex inside of it, of whole spindles only; else MENISCUS_NONE */
  double area;  /* Å^2 */
} meniscus_face;

/* The areas of atoms are computed at the first call for them, in about a third of the surface's time. */
MENISCUS_API meniscus_status meniscus_surface_table(const meniscus_surface* surface, meniscus_surface_table_id table,
                                                    meniscus_array* array);

/* The Euclidean distance of each point to the nearest point of the surface: above 0 in the solvent, below 0 in the
 * solid (for MENISCUS_SES the solid is what no probe reaches, and cavities are solvent; for the other kinds it is the
 * union of the balls). Exact except for rounding, also far away; where atoms touch in one point, within 1e-6 Å. points:
 * count times x, y, z, each at most 1e150 Å. distances: room for count. nearest: NULL, or room for count points: the
 * nearest points of the surface, one of them where there are several. The arrays must not overlap, but nearest may
 * equal points. */
MENISCUS_API meniscus_status meniscus_surface_distance(const meniscus_surface* surface, size_t count,
                                                       const double* points, double* distances, double* nearest);

/* The quantity whose derivative meniscus_surface_gradient computes. */
typedef enum meniscus_quantity MENISCUS_WORDS {
  MENISCUS_GRADIENT_AREA = 0,      /* of the surface's area */
  MENISCUS_GRADIENT_VOLUME = 1,    /* of its volume */
  MENISCUS_GRADIENT_SAS_AREA = 2,  /* of the sum of MENISCUS_ATOM_SAS_AREAS; of MENISCUS_SES only */
  MENISCUS_GRADIENT_SAS_VOLUME = 3 /* of the volume where the probe's centre cannot be; of MENISCUS_SES only */
} meniscus_quantity;

/* The exact derivative with respect to the position of each atom, in closed form, for forces and minimizers. gradient:
 * room for three doubles per atom, Å^2/Å or Å^3/Å. weights: [NULL: 1 for all] one finite number per atom, a factor of
 * its accessible area such as an atomic solvation parameter; for MENISCUS_GRADIENT_SAS_AREA, and for
 * MENISCUS_GRADIENT_AREA of MENISCUS_SAS and MENISCUS_VDW. MENISCUS_INPUT where a probe touches more than three atoms
 * at once, so that MENISCUS_GRADIENT_AREA and _VOLUME of MENISCUS_SES have no derivative. */
MENISCUS_API meniscus_status meniscus_surface_gradient(const meniscus_surface* surface, meniscus_quantity quantity,
                                                       const double* weights, double* gradient);

/* ---- Molecules from files ------------------------------------------------------------------------------------ */

/* What to do with hydrogens. */
typedef enum meniscus_hydrogens MENISCUS_WORDS {
  MENISCUS_HYDROGENS_AUTO = 0, /* left out if the radii include them, else kept */
  MENISCUS_HYDROGENS_KEEP = 1,
  MENISCUS_HYDROGENS_DROP = 2
} meniscus_hydrogens;

/* What to do with atoms of unknown element. */
typedef enum meniscus_unknown_element MENISCUS_WORDS {
  MENISCUS_UNKNOWN_HALT = 0,  /* MENISCUS_INPUT, naming them */
  MENISCUS_UNKNOWN_GUESS = 1, /* a radius of 2.0 Å */
  MENISCUS_UNKNOWN_SKIP = 2   /* left out */
} meniscus_unknown_element;

/* Which atoms of a file are used, and their radii: the options of the program, with its defaults. Texts are read
 * during the call only. */
typedef struct meniscus_read_options {
  size_t size;
  const char* select;             /* [NULL: all] an expression such as "chain A and not water" (meniscus help
                                     selections) */
  const char* assembly;           /* [NULL: as deposited] build this biological assembly, "1" */
  const char* altloc;             /* ["best": the most occupied] alternate location in a residue: "first", "all" or one
                                     letter */
  const char* radii;              /* [NULL: those of the file if it has any, else "bondi"] also "united", "protor",
                                     "file" */
  const char* const* radii_files; /* [NULL] radii by residue and atom, before those of the set; the last counts */
  const char* const* radius;    /* [NULL] "EXPR=R": the radius R, Å, of the atoms that EXPR selects; the last counts */
  size_t radii_file_count;      /* [0] */
  size_t radius_count;          /* [0] */
  int32_t model;                /* [1] the first; 0: all models as one molecule */
  meniscus_hydrogens hydrogens; /* [MENISCUS_HYDROGENS_AUTO] */
  meniscus_unknown_element unknown_element; /* [MENISCUS_UNKNOWN_HALT] */
  int32_t keep_water;                       /* [0] else: water molecules, too */
  int32_t keep_ions;                        /* [0] else: free ions, too */
  int32_t reserved;                         /* 0 */
} meniscus_read_options;

#define MENISCUS_READ_OPTIONS_INIT                                                                         \
  {                                                                                                        \
    sizeof(meniscus_read_options), NULL, NULL, "best", NULL, NULL, NULL, 0, 0, 1, MENISCUS_HYDROGENS_AUTO, \
        MENISCUS_UNKNOWN_HALT, 0, 0, 0                                                                     \
  }
MENISCUS_API meniscus_status meniscus_default_read_options(meniscus_read_options* options);

/* The atoms of a molecule, as a surface uses them. It never changes. */
typedef struct meniscus_structure meniscus_structure;

/* Reads PDB, mmCIF, BinaryCIF, SDF, MOL2, PDBQT, PQR, GRO, XYZ and XYZR, plain or packed with gzip, as the program
 * does. Unless the options say otherwise it uses the polymers and ligands of the first model, with the most occupied
 * conformer of each residue, and leaves out water and free ions. options: NULL for the defaults. *structure is
 * overwritten. For an invalid selection meniscus_last_error() has two more lines: the expression, and a caret below the
 * error. */
MENISCUS_API meniscus_status meniscus_read(const char* path, const meniscus_read_options* options,
                                           meniscus_structure** structure);
MENISCUS_API meniscus_structure* meniscus_structure_retain(meniscus_structure* structure);
MENISCUS_API void meniscus_structure_release(meniscus_structure* structure);

/* Fills in the argument of meniscus_compute(); its arrays live as long as the structure. atoms->size has to be set. */
MENISCUS_API meniscus_status meniscus_structure_atoms(const meniscus_structure* structure, meniscus_atoms* atoms);

/* Texts live as long as the structure. */
typedef struct meniscus_read_report {
  size_t size;
  const char* file;      /* the path as given */
  const char* format;    /* "PDB", "mmCIF", ... */
  const char* radii_set; /* "bondi", "united", "protor", "file", or files and overrides */
  const char* sentence;  /* "5,684 atoms read; 215 water left out; 5,469 used" */
  uint64_t read;         /* atoms of the file, of all models and alternate locations */
  uint64_t atoms;        /* those used, copies of an assembly included */
  uint64_t models;       /* in the file */
} meniscus_read_report;

/* report->size has to be set. */
MENISCUS_API meniscus_status meniscus_structure_report(const meniscus_structure* structure,
                                                       meniscus_read_report* report);

/* The tables of a structure: one row per atom, except for warnings. Rows of text end with a zero and are padded with
 * zeros to the stride; they come from the file, so they are usually UTF-8, but may be any bytes. */
typedef enum meniscus_structure_table_id MENISCUS_WORDS {
  MENISCUS_STRUCTURE_POSITIONS = 0,     /* double[3], Å */
  MENISCUS_STRUCTURE_RADII = 1,         /* double, Å */
  MENISCUS_STRUCTURE_ELEMENTS = 2,      /* uint8_t: atomic number, 0 where it is unknown */
  MENISCUS_STRUCTURE_INDICES = 3,       /* uint32_t: position in the file, from 0, among all atoms of all models read */
  MENISCUS_STRUCTURE_NAMES = 4,         /* text: "CA" */
  MENISCUS_STRUCTURE_RESIDUE_NAMES = 5, /* text: "ALA" */
  MENISCUS_STRUCTURE_CHAINS = 6,        /* text: "A", of the second copy in an assembly "A-2" */
  MENISCUS_STRUCTURE_SEGMENTS = 7,      /* text */
  MENISCUS_STRUCTURE_RESIDUE_NUMBERS = 8, /* int32_t, as the file has them */
  MENISCUS_STRUCTURE_INSERTION_CODES = 9, /* char, ' ' for none */
  MENISCUS_STRUCTURE_ALTLOCS = 10,        /* char, ' ' for none */
  MENISCUS_STRUCTURE_RESIDUES = 11,       /* uint32_t: running number of the residue in the file, from 0 */
  MENISCUS_STRUCTURE_MODELS = 12,         /* int32_t, from 1 */
  MENISCUS_STRUCTURE_COPIES = 13,         /* uint32_t: which copy of an assembly, from 0 */
  MENISCUS_STRUCTURE_CHARGES = 14,        /* float, e; NaN where the file has none */
  MENISCUS_STRUCTURE_B_FACTORS = 15,      /* float, Å^2; likewise */
  MENISCUS_STRUCTURE_OCCUPANCIES = 16,    /* float; likewise */
  MENISCUS_STRUCTURE_CLASSES = 17,        /* uint8_t: 0 polymer, 1 ligand, 2 water, 3 ion, 4: the file does not say */
  MENISCUS_STRUCTURE_WARNINGS = 18,       /* text: one sentence per row about unusual things in the file */
  MENISCUS_STRUCTURE_HYDROPATHIES = 19    /* double, of the residue (Kyte & Doolittle 1982); NaN: not an amino acid */
} meniscus_structure_table_id;

MENISCUS_API meniscus_status meniscus_structure_table(const meniscus_structure* structure,
                                                      meniscus_structure_table_id table, meniscus_array* array);

/* The colours that the program gives the atoms. scheme: "chain", "bfactor" or another word of `meniscus colors` that
 * colours atoms by data of the file, a name such as "red", or "#rrggbb"; MENISCUS_USAGE for others. atom_colors: room
 * for three floats per atom, sRGB in [0, 1], as meniscus_render() takes them. MENISCUS_INPUT for a scheme of numbers
 * that no atom of the file has. */
MENISCUS_API meniscus_status meniscus_structure_colors(const meniscus_structure* structure, const char* scheme,
                                                       float* atom_colors);

/* ---- Pockets ------------------------------------------------------------------------------------------------- */

typedef struct meniscus_pocket_options {
  size_t size;
  double large_probe_radius; /* [4] above the surface's probe, at most 100: larger ones find wider, shallower pockets */
  double trim;               /* [1] Å, 0 to 100: pockets begin this far below the large probe's surface */
  double min_volume;         /* [30] Å^3, 0 to 1e9: smaller ones are left out */
  double mouth_tolerance;    /* [0.1] Å, 0.001 to 1: largest error of a mouth's position */
} meniscus_pocket_options;

#define MENISCUS_POCKET_OPTIONS_INIT \
  { sizeof(meniscus_pocket_options), 4.0, 1.0, 30.0, 0.1 }
MENISCUS_API meniscus_status meniscus_default_pocket_options(meniscus_pocket_options* options);

/* Pockets, tunnels and cavities of a molecule: the connected regions that its probe can fill inside the solid that a
 * large probe rolls over. Volumes and areas are in closed form, without a grid. */
typedef struct meniscus_pockets meniscus_pockets;

/* Finds the pockets of a surface of MENISCUS_SES with a probe above 0; always on the CPU. options: NULL for the
 * defaults. *pockets is overwritten; it does not need the surface any longer. */
MENISCUS_API meniscus_status meniscus_surface_pockets(const meniscus_surface* surface,
                                                      const meniscus_pocket_options* options,
                                                      meniscus_pockets** pockets);
MENISCUS_API meniscus_pockets* meniscus_pockets_retain(meniscus_pockets* pockets);
MENISCUS_API void meniscus_pockets_release(meniscus_pockets* pockets);

/* The tables of pockets, and what their rows are. */
typedef enum meniscus_pockets_table_id MENISCUS_WORDS {
  MENISCUS_POCKETS = 0,       /* meniscus_pocket: the largest volume first */
  MENISCUS_POCKET_MOUTHS = 1, /* double: Å^2 of each mouth, of a pocket the largest first */
  MENISCUS_POCKET_ATOMS = 2,  /* uint32_t: atoms that line a pocket, which the probe in it can touch; ascending */
  MENISCUS_POCKET_PROBES = 3  /* double[3]: centres of the probe at rest in a pocket, touching three atoms or more */
} meniscus_pockets_table_id;

/* One connected part. */
typedef struct meniscus_pocket {
  double volume;        /* Å^3 */
  double volume_excess; /* Å^3 by which it is too large at most, to first order, because mouths lie outside */
  double area;          /* Å^2 of its whole border */
  double mouth_area;    /* Å^2 of its mouths; the rest is wall */
  double depth;         /* Å, of the deepest probe at rest below the large probe's surface */
  double middle[3];     /* the mean of the probes at rest */
  uint32_t first_mouth, mouth_count; /* none: a cavity; one: a pocket; more: a tunnel */
  uint32_t first_atom, atom_count;
  uint32_t first_probe, probe_count;
} meniscus_pocket;

MENISCUS_API meniscus_status meniscus_pockets_table(const meniscus_pockets* pockets, meniscus_pockets_table_id table,
                                                    meniscus_array* array);

/* ---- Meshes -------------------------------------------------------------------------------------------------- */

/* How the triangles of a mesh are made. */
typedef enum meniscus_mesh_method MENISCUS_WORDS {
  MENISCUS_MESH_BY_PATCH = 0,  /* triangles end at borders of patches, within `tolerance` */
  MENISCUS_MESH_EVEN = 1,      /* nearly equilateral triangles, within `tolerance` */
  MENISCUS_MESH_BY_DENSITY = 2 /* nearly equilateral triangles, their number by `density` */
} meniscus_mesh_method;

/* A number that the method does not use must have its default, else it is refused. */
typedef struct meniscus_mesh_options {
  size_t size;
  meniscus_mesh_method method; /* [MENISCUS_MESH_BY_PATCH] */
  int32_t split_colors; /* [1] of MENISCUS_MESH_BY_PATCH: cut triangles where the nearest contact changes, so that
                           colours change along edges */
  double tolerance;     /* [0.01] Å, 0.00001 to 1: no point of the mesh is farther from the surface */
  double density;       /* [0] vertices per Å^2 of the exact area, 0.005 to 1,000 */
} meniscus_mesh_options;

#define MENISCUS_MESH_OPTIONS_INIT \
  { sizeof(meniscus_mesh_options), MENISCUS_MESH_BY_PATCH, 1, 0.01, 0.0 }
MENISCUS_API meniscus_status meniscus_default_mesh_options(meniscus_mesh_options* options);

/* A closed triangle mesh. All vertices lie on the exact surface, which the mesh keeps for meniscus_mesh_save. Triangles
 * are counter-clockwise, seen from the solvent. MENISCUS_MESH_BY_PATCH: they end at borders of patches, however narrow
 * these are. The other methods: nearly equilateral triangles, as few as one per atom, cross borders; the atom, kind,
 * face and patch of a triangle are those of the exact surface below its middle. No triangles of such a mesh cross. */
typedef struct meniscus_mesh meniscus_mesh;

/* options: NULL for the defaults. *mesh is overwritten. */
MENISCUS_API meniscus_status meniscus_surface_mesh(const meniscus_surface* surface,
                                                   const meniscus_mesh_options* options, meniscus_mesh** mesh);
MENISCUS_API meniscus_mesh* meniscus_mesh_retain(meniscus_mesh* mesh);
MENISCUS_API void meniscus_mesh_release(meniscus_mesh* mesh);

/* The tables of a mesh. */
typedef enum meniscus_mesh_table_id MENISCUS_WORDS {
  MENISCUS_MESH_POSITIONS = 0,           /* double[3] per vertex */
  MENISCUS_MESH_NORMALS = 1,             /* double[3] per vertex, unit, exact; at cusps a mean */
  MENISCUS_MESH_TRIANGLES = 2,           /* uint32_t[3] per triangle: vertices */
  MENISCUS_MESH_TRIANGLE_ATOMS = 3,      /* uint32_t per triangle: the atom whose contact is nearest */
  MENISCUS_MESH_TRIANGLE_KINDS = 4,      /* uint8_t per triangle: MENISCUS_KIND_... */
  MENISCUS_MESH_TRIANGLE_FACES = 5,      /* uint32_t per triangle: row of MENISCUS_FACES */
  MENISCUS_MESH_TRIANGLE_PATCHES = 6,    /* uint32_t per triangle: row of the table of its kind */
  MENISCUS_MESH_TRIANGLE_COMPONENTS = 7, /* uint32_t per triangle */
  MENISCUS_MESH_SHARP_CORNERS = 8,       /* uint32_t, ascending: corners (3 * triangle + 0, 1, 2) at cusps, where */
  MENISCUS_MESH_SHARP_NORMALS = 9,       /* double[3]: these are the exact normals */
  MENISCUS_MESH_VERTEX_ATOMS = 10        /* uint32_t per vertex: the atom whose contact is nearest; where several are
                                            equally near the first */
} meniscus_mesh_table_id;

MENISCUS_API meniscus_status meniscus_mesh_table(const meniscus_mesh* mesh, meniscus_mesh_table_id table,
                                                 meniscus_array* array);

/* How a mesh is written. Texts are read during the call only. */
typedef struct meniscus_mesh_file {
  size_t size;
  const char* format;       /* [NULL: by the ending of the path] "stl", "3mf", "obj", "off", "glb", "vtp", "smesh",
                               "dms", "ply", "ply-ascii", "py", "usda" or "usdz" */
  const char* attributes;   /* ["usual"] numbers of vertices in GLB, PLY, VTP and USD, separated by commas: "vdw_radii",
                               "atom_index", "ses_kind" and "ses_component", which are the usual ones,
                               "mean_curvature", "gaussian_curvature", "smooth_mean_curvature",
                               "smooth_gaussian_curvature", "atom_area", "accessible_area", "patch_area",
                               "open_sky", "atom_open_sky"; "all" but the last two, "none" */
  const float* atom_colors; /* [NULL: all have `color`] sRGB in [0, 1], three per atom; read during the call only */
  double scale;             /* [1] length in the file of 1 Å, 1e-12 to 1e6; 3MF has mm, GLB m; DMS is in Å always */
  float color[3];           /* [0.75, 0.82, 0.9] sRGB in [0, 1] */
  int32_t replace;          /* [0: refuse] else: replace an existing file */
} meniscus_mesh_file;

#define MENISCUS_MESH_FILE_INIT \
  { sizeof(meniscus_mesh_file), NULL, "usual", NULL, 1.0, {0.75f, 0.82f, 0.9f}, 0 }
MENISCUS_API meniscus_status meniscus_default_mesh_file(meniscus_mesh_file* file);

/* Writes a mesh, completely or not at all. Edges shorter than 0.001 Å and triangles without area in single precision
 * are welded in the file, not in the mesh. The mesh keeps its surface, even if that was released or computed again.
 * path: in the encoding of the system's file names. file: NULL for the defaults. MENISCUS_NOT_CLOSED if "smesh" finds
 * no point inside a component. 3MF is compressed. */
MENISCUS_API meniscus_status meniscus_mesh_save(const meniscus_mesh* mesh, const char* path,
                                                const meniscus_mesh_file* file);

/* ---- Pictures ------------------------------------------------------------------------------------------------ */

typedef enum meniscus_projection MENISCUS_WORDS {
  MENISCUS_PERSPECTIVE = 0,
  MENISCUS_ORTHOGRAPHIC = 1
} meniscus_projection;

typedef struct meniscus_camera {
  size_t size;
  double position[3], target[3];
  double up[3];                   /* not parallel to the view */
  double vertical_fov;            /* degrees between the picture's lower and upper edge; perspective only */
  double height;                  /* Å between them; orthographic only */
  meniscus_projection projection; /* MENISCUS_PERSPECTIVE or MENISCUS_ORTHOGRAPHIC */
  int32_t reserved;               /* 0 */
} meniscus_camera;

/* The camera that shows all atoms, their widest side across the picture. aspect: width / height. camera->size has to be
 * set. */
MENISCUS_API meniscus_status meniscus_surface_camera(const meniscus_surface* surface, double aspect,
                                                     meniscus_projection projection, meniscus_camera* camera);

/* Everything that can be chosen for a picture, as one value: the molecule's file and its atoms, their surface and its
 * colours, what is drawn beside it, the view, the look, the annotations. A new scene has the defaults of the program.
 * Each value has a name, that of the program's option with "_" for "-" ("depth_cue"), and a key, that of scene files
 * ("look.depth_cue"); meniscus_scene_properties() lists all. Values are text as on the command line, with its units:
 * "7pt", "0.5", "chain A"; flags are "true" or "false". */
typedef struct meniscus_scene meniscus_scene;

/* *scene is overwritten, here and below. */
MENISCUS_API meniscus_status meniscus_scene_new(meniscus_scene** scene);
/* Reads a scene file of the program. Paths in it are relative to its folder and must stay inside it, because a scene
 * may come from anyone. MENISCUS_INPUT names the file, and the line or the place in it. */
MENISCUS_API meniscus_status meniscus_scene_read(const char* path, meniscus_scene** scene);
/* Reads the text of a scene. Paths are relative to the working directory, and may lead anywhere. */
MENISCUS_API meniscus_status meniscus_scene_parse(const char* json, meniscus_scene** scene);
MENISCUS_API meniscus_scene* meniscus_scene_retain(meniscus_scene* scene);
MENISCUS_API void meniscus_scene_release(meniscus_scene* scene);

/* Sets the value of a name or key, or adds it if it is repeatable. value: NULL for the default, or to remove all values
 * that were added. MENISCUS_USAGE for an unknown name or an invalid value; the text begins with the name, and for a
 * selection has two more lines, as for meniscus_read(). */
MENISCUS_API meniscus_status meniscus_scene_set(meniscus_scene* scene, const char* name, const char* value);
/* The value, which lives as long as the scene; NULL for the default. n: 0, or the index of an added value. */
MENISCUS_API meniscus_status meniscus_scene_get(const meniscus_scene* scene, const char* name, size_t n,
                                                const char** value);
/* The scene as JSON, without values that are defaults. It lives as long as the scene. folder: its paths are relative
 * to this; NULL: the working directory. */
MENISCUS_API meniscus_status meniscus_scene_json(const meniscus_scene* scene, const char* folder, const char** json);
/* The size of its picture in pixels. MENISCUS_USAGE for values that contradict each other. */
MENISCUS_API meniscus_status meniscus_scene_size(const meniscus_scene* scene, int32_t* width, int32_t* height);

/* meniscus_property.type: what a value is. */
typedef enum meniscus_value_type MENISCUS_WORDS {
  MENISCUS_VALUE_FLAG = 0, /* "true" or "false" */
  MENISCUS_VALUE_NUMBER = 1,
  MENISCUS_VALUE_COUNT = 2,    /* a whole number */
  MENISCUS_VALUE_WORD = 3,     /* one of `words` */
  MENISCUS_VALUE_TEXT = 4,     /* with a syntax of its own: a selection, a colour, a length such as "0.5pt" */
  MENISCUS_VALUE_FILE = 5,     /* the path of a file that is read */
  MENISCUS_VALUE_NEW_FILE = 6, /* the path of a file that is written; this library does not */
  MENISCUS_VALUE_CAMERA = 7    /* a camera as JSON, or the path of a file that has one */
} meniscus_value_type;

/* A value that a scene can have. Texts live as long as the library; "" where there is none. */
typedef struct meniscus_property {
  const char* name;       /* "depth_cue" */
  const char* key;        /* "look.depth_cue" */
  const char* value;      /* what the help calls the value: "WIDTH"; "" of flags */
  const char* help;       /* a sentence, in the units of the value */
  const char* words;      /* "ses|sas|vdw": all of MENISCUS_VALUE_WORD; else some that are usual */
  const char* initial;    /* the default, as the help has it */
  double lowest, highest; /* of numbers, counts and lengths in pixels; equal: any */
  meniscus_value_type type;
  int32_t repeatable; /* 1: it may be set several times */
  int32_t of_surface; /* 1: meniscus_render() uses it, too */
  int32_t reserved;   /* 0 */
} meniscus_property;

/* Rows of meniscus_property, in the order of the help. */
MENISCUS_API meniscus_status meniscus_scene_properties(meniscus_array* array);

/* Draws pictures. On GL it has a context and a thread of its own, so that the caller's contexts are not touched. */
typedef struct meniscus_renderer meniscus_renderer;

/* device: MENISCUS_AUTO (a hardware GPU if one works, else as MENISCUS_CPU), MENISCUS_GPU, MENISCUS_SOFTWARE,
 * MENISCUS_CPU (without GL: the same picture for any vector width and number of threads). *renderer is overwritten.
 * MENISCUS_NO_GPU if GL is asked for and there is no GL 4.5. */
MENISCUS_API meniscus_status meniscus_renderer_new(meniscus_device device, meniscus_renderer** renderer);
MENISCUS_API meniscus_renderer* meniscus_renderer_retain(meniscus_renderer* renderer);
MENISCUS_API void meniscus_renderer_release(meniscus_renderer* renderer);

/* Draws a scene as `meniscus render` does, to the byte: reads its molecule, computes its surface and the shapes beside
 * it, and draws its legend, labels and scale bar. The device is that of the renderer; the scene's `output` and
 * `legend_file` are not written. rgba: width * height * 4 bytes of meniscus_scene_size(), red, green, blue, alpha (not
 * premultiplied), rows from the top; rgba_size: the size of that memory. Errors are those of meniscus_read(),
 * meniscus_compute() and meniscus_scene_set(); MENISCUS_USAGE for a run of frames. */
MENISCUS_API meniscus_status meniscus_render_scene(meniscus_renderer* renderer, const meniscus_scene* scene,
                                                   uint8_t* rgba, size_t rgba_size);

/* Draws an exact surface of the caller. scene: NULL for the defaults; its look, its picture ("look." and "image." in
 * scene files), `projection` and a single `color` are used, and MENISCUS_USAGE names any other value that is set.
 * camera: NULL for meniscus_surface_camera(). atom_colors: NULL, or sRGB in [0, 1], three per atom. rgba as above. */
MENISCUS_API meniscus_status meniscus_render(meniscus_renderer* renderer, const meniscus_surface* surface,
                                             const meniscus_scene* scene, const meniscus_camera* camera,
                                             const float* atom_colors, uint8_t* rgba, size_t rgba_size);

/* ---- Pages --------------------------------------------------------------------------------------------------- */

/* A web page of one file in which readers turn the exact surface: it fetches nothing, and casts the patches in their
 * browser by WebGL 2; others see a still picture that is in it. Its colours, views, cut, chains and PNGs are chosen
 * there (see docs/how-to/pages.md). */
typedef struct meniscus_page meniscus_page;

/* The page of a scene, as `meniscus export page` makes it: reads its molecule, and computes its surface and the shapes
 * beside it, on the CPU. The scene's `output`, legend, title and scale bar are not used. *page is overwritten. Errors
 * are those of meniscus_render_scene(); MENISCUS_USAGE for what pages do not show, such as `object`. */
MENISCUS_API meniscus_status meniscus_scene_page(const meniscus_scene* scene, meniscus_page** page);

/* The page of an exact surface of the caller. structure: NULL, or what names its atoms, in the same order; readers can
 * then choose its schemes of colours, too. scene, camera, atom_colors: as for meniscus_render(). */
MENISCUS_API meniscus_status meniscus_surface_page(const meniscus_surface* surface, const meniscus_structure* structure,
                                                   const meniscus_scene* scene, const meniscus_camera* camera,
                                                   const float* atom_colors, meniscus_page** page);
MENISCUS_API meniscus_page* meniscus_page_retain(meniscus_page* page);
MENISCUS_API void meniscus_page_release(meniscus_page* page);

/* The text of the page, UTF-8, which lives as long as the page. size: NULL, or its bytes without the zero at its end.
 */
MENISCUS_API meniscus_status meniscus_page_html(const meniscus_page* page, const char** html, size_t* size);

#ifdef __cplusplus
}
#endif

#endif
