// Which edges are chamfered, what their width measures, and where it differs.
using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using Chamfer;
using Chamfer.Interop;
using Chamfer.Streams;
using ChamferEditor;
using UnityEditor;
using UnityEngine;

namespace Chamfer.Tests
{
    internal static unsafe class EdgeTests
    {
        /// A fifth of a unit, where the cube's side is 2.
        private static ChamferSettings Fifth(EdgeSettings edges)
        {
            var settings = ChamferSettings.Default;
            settings.unit = WidthUnit.MeshUnits;
            settings.width = 0.2f;
            settings.edges = edges;
            return settings;
        }

        private static EdgeSettings Materials(params object[] namesAndFactors)
        {
            var factors = new MaterialFactor[namesAndFactors.Length / 2];
            for (int i = 0; i < factors.Length; i++)
            {
                factors[i].material = (string)namesAndFactors[2 * i];
                factors[i].factor = (float)namesAndFactors[2 * i + 1];
            }
            return new EdgeSettings { materials = factors };
        }

        /// The width of each edge, in order; none of those that are not selected.
        private static float[] Widths(ChamferReport report)
        {
            Check.Equal(12, report.Verdicts.Count);
            var full = report.Verdicts.Where(one => one.Outcome == EdgeOutcome.Full).ToArray();
            Check.Equal(12 - full.Length, report.Count(EdgeOutcome.Skipped, EdgeReason.NotSelected));
            return full.Select(one => one.FirstWidth).OrderBy(width => width).ToArray();
        }

        private static float[] Widths(Mesh mesh, EdgeSettings edges)
        {
            return Widths(MeshChamfer.Run(mesh, Fifth(edges)).Report);
        }

        private static void AllNear(float expected, int count, IEnumerable<float> found)
        {
            Check.Equal(count, found.Count());
            foreach (float one in found) { Check.Near(expected, one); }
        }

        /// How far inside along an axis what was pulled lies.
        private static float Inset(Mesh cube, Func<Vector3, float> axis)
        {
            return 1 - cube.vertices.Select(p => Math.Abs(axis(p))).Where(place => place < 0.999f).Max();
        }

        private static void IsInset(float x, float y, float z, Mesh cube)
        {
            Check.Near(x, Inset(cube, p => p.x));
            Check.Near(y, Inset(cube, p => p.y));
            Check.Near(z, Inset(cube, p => p.z));
        }

        private static Vector3 Scale(float x, float y, float z) { return new Vector3(x, y, z); }

        private static Matrix4x4 At(float x, float scale = 1)
        {
            return Matrix4x4.TRS(new Vector3(x, 0, 0), new Quaternion(), new Vector3(scale, 1, 1));
        }

        /// As settings are that an earlier version has written.
        public static void Settings_without_edges_ask_for_nothing()
        {
            var options = NativeInput.Options(ChamferSettings.Default);
            Check.Equal(0u, options.WidthMode + options.Convexity);
            Check.Equal(0f, options.MinAngle + options.MaxAngle + options.HardAngle);
            for (int i = 0; i < 9; i++) { Check.Equal(0f, options.Scale[i]); }
            using (var pins = new PinnedArrays())
            {
                var mesh = NativeInput.Mesh(MeshReader.Read(Shapes.FullCube()), pins);
                Check.That(mesh.SubmeshFactors == IntPtr.Zero && mesh.VertexFactors == IntPtr.Zero, "no factors");
            }
            AllNear(0.2f, 12, Widths(Shapes.FullCube(), new EdgeSettings()));
        }

        /// They are what models depend on, and what shared meshes are found by.
        public static void Texts_of_settings_without_edges_are_what_they_were()
        {
            var settings = ChamferSettings.Default;
            Check.Equal("0.5 PercentOfExtent Full Owner 0 0", SettingsText.Of(settings));
            settings.edges.materials = new MaterialFactor[0];
            Check.Equal("0.5 PercentOfExtent Full Owner 0 0", SettingsText.Of(settings));
            Check.Equal("0.5 percent, Full", SettingsText.Words(settings));
        }

        public static void Every_setting_of_edges_is_told_in_the_text()
        {
            var all = new[]
            {
                new EdgeSettings(),
                new EdgeSettings { widthMode = WidthMode.Depth },
                new EdgeSettings { worldWidth = true },
                new EdgeSettings { minAngle = 5 },
                new EdgeSettings { maxAngle = 5 },
                new EdgeSettings { convexity = EdgeConvexity.Convex },
                new EdgeSettings { hardAngle = 5 },
                new EdgeSettings { mask = MaskChannel.Red },
                Materials("Wood", 0.5f),
                Materials("Wood", 0.25f),
                Materials("Wood=0.5 4:Wood", 0.5f),
                Materials("Wood", 0.5f, "Wood", 0.5f)
            };
            Check.Equal(all.Length, all.Select(edges => SettingsText.Of(Fifth(edges))).Distinct().Count());
            Check.That(SettingsText.Words(Fifth(all[1])).EndsWith("chosen edges"), "in words");
        }

        public static void The_width_measures_what_is_asked_for()
        {
            float root = (float)Math.Sqrt(2);
            var modes = new Dictionary<WidthMode, float>
            {
                { WidthMode.Offset, 0.2f }, { WidthMode.Chord, 0.2f / root }, { WidthMode.Depth, 0.2f * root }, { WidthMode.Radius, 0.2f }
            };
            foreach (var mode in modes) { AllNear(mode.Value, 12, Widths(Shapes.Cube(), new EdgeSettings { widthMode = mode.Key })); }
        }

        public static void Edges_are_selected_by_angle_and_convexity()
        {
            Check.Equal(12, Widths(Shapes.Cube(), new EdgeSettings { minAngle = 89, maxAngle = 91 }).Length);
            Check.Equal(0, Widths(Shapes.Cube(), new EdgeSettings { minAngle = 91 }).Length);
            Check.Equal(0, Widths(Shapes.Cube(), new EdgeSettings { maxAngle = 89 }).Length);
            Check.Equal(12, Widths(Shapes.Cube(), new EdgeSettings { convexity = EdgeConvexity.Convex }).Length);
            Check.Equal(0, Widths(Shapes.Cube(), new EdgeSettings { convexity = EdgeConvexity.Concave }).Length);
        }

        /// Normals that lean so far to the corner that those of two faces differ by 30 degrees.
        public static void Normals_are_one_below_the_hard_angle()
        {
            var cube = Shapes.Cube();
            var positions = cube.vertices;
            cube.normals = cube.normals.Select((n, i) => n + positions[i] * (2 / (float)Math.Sqrt(3))).Select(n => n * (1 / n.magnitude)).ToArray();
            Func<float, int> count = angle => MeshChamfer.Run(cube, Fifth(new EdgeSettings { hardAngle = angle })).Report.HardEdges;
            Check.Equal(12, count(0));
            Check.Equal(12, count(25));
            Check.Equal(0, count(35));
        }

        public static void A_colour_channel_is_a_mask()
        {
            var cube = Shapes.Cube();
            cube.colors = cube.vertices.Select(p => new Color(3, 0.5f, 0.25f, -1)).ToArray();
            AllNear(0.2f, 12, Widths(cube, new EdgeSettings()));
            AllNear(0.2f, 12, Widths(cube, new EdgeSettings { mask = MaskChannel.Red }));
            AllNear(0.1f, 12, Widths(cube, new EdgeSettings { mask = MaskChannel.Green }));
            AllNear(0.05f, 12, Widths(cube, new EdgeSettings { mask = MaskChannel.Blue }));
            Check.Equal(0, Widths(cube, new EdgeSettings { mask = MaskChannel.Alpha }).Length);
            AllNear(0.2f, 12, Widths(Shapes.Cube(), new EdgeSettings { mask = MaskChannel.Red }));
        }

        /// The first three faces are of one submesh, the others of a second.
        private static Mesh TwoSubmeshes()
        {
            var cube = Shapes.Cube();
            var indices = cube.GetIndices(0);
            cube.subMeshCount = 2;
            cube.SetTriangles(indices.Take(18).ToArray(), 0);
            cube.SetTriangles(indices.Skip(18).ToArray(), 1);
            return cube;
        }

        private static float[] MaterialWidths(EdgeSettings edges, params string[] names)
        {
            var materials = names.Select(name => name == null ? null : new Material { name = name }).ToArray();
            var placed = new PlacedMesh(TwoSubmeshes(), Matrix4x4.identity) { Materials = materials };
            return Widths(MeshChamfer.RunScene(new[] { placed }, Fifth(edges)).Values.Single().Report);
        }

        public static void Each_material_has_a_factor()
        {
            // Between the last three faces there are two edges that no other touches.
            var half = MaterialWidths(Materials("Glass", 2f, "Wood", 0.5f, "Wood", 0f), "Wood", "Plaster");
            AllNear(0.1f, 10, half.Take(10));
            AllNear(0.2f, 2, half.Skip(10));
            AllNear(0.4f, 12, MaterialWidths(Materials("Glass", 2f), "Glass", "Glass"));
            Check.Equal(0, MaterialWidths(Materials("Wood", 0f), "Wood", "Wood").Length);
            AllNear(0.2f, 12, MaterialWidths(Materials("Wood", 0f), "wood", "Wood (Instance)"));
        }

        public static void Submeshes_without_a_material_have_the_whole_width()
        {
            var half = MaterialWidths(Materials("Wood", 0.5f), "Wood");
            AllNear(0.1f, 10, half.Take(10));
            AllNear(0.2f, 2, half.Skip(10));
            AllNear(0.2f, 12, MaterialWidths(Materials("", 0f), null, "Stone"));
            AllNear(0.2f, 12, Widths(TwoSubmeshes(), Materials("Wood", 0f)));
        }

        public static void A_wrong_factor_names_its_material()
        {
            foreach (float wrong in new[] { -1, float.NaN, float.PositiveInfinity })
            {
                var told = Check.Throws<InvalidSettingsException>(() => Widths(Shapes.Cube(), Materials("Oak", 1f, "Wood", wrong)));
                Check.That(told.Message.Contains("'Wood' is " + wrong + ": give a finite number of at least 0"), told.Message);
            }
        }

        public static void Wrong_angles_are_named_with_their_range()
        {
            Action<EdgeSettings, string> refused = (edges, words) =>
            {
                var told = Check.Throws<InvalidSettingsException>(() => Widths(Shapes.Cube(), edges));
                Check.That(told.Message.Contains(words), told.Message);
            };
            refused(new EdgeSettings { minAngle = -1 }, "min_angle is -1: give degrees from 0 to 180");
            refused(new EdgeSettings { maxAngle = 181 }, "max_angle is 181: give degrees from 0 to 180");
            refused(new EdgeSettings { hardAngle = 91 }, "hard_angle is 91: give degrees from 0 to 90");
            refused(new EdgeSettings { minAngle = 60, maxAngle = 30 }, "min_angle 60 is larger than max_angle 30");
            refused(new EdgeSettings { widthMode = (WidthMode)4 }, "width_mode is 4");
            refused(new EdgeSettings { convexity = (EdgeConvexity)3 }, "convexity is 3");
        }

        private static Mesh InWorld(PlacedMesh placed, bool worldWidth = true, bool isPercent = false)
        {
            var settings = Fifth(new EdgeSettings { worldWidth = worldWidth });
            if (isPercent) { settings.unit = WidthUnit.PercentOfExtent; settings.width = 5; }
            return MeshChamfer.RunScene(new[] { placed }, settings).Values.Single().Mesh;
        }

        /// Twice as long along x, where a width is half as much of the mesh; 5 percent of 4 is a fifth.
        public static void World_width_is_measured_where_the_mesh_stands()
        {
            IsInset(0.1f, 0.2f, 0.2f, InWorld(new PlacedMesh(Shapes.Cube(), At(7, 2))));
            IsInset(0.1f, 0.2f, 0.2f, InWorld(new PlacedMesh(Shapes.Cube(), At(7, -2))));
            IsInset(0.1f, 0.2f, 0.2f, InWorld(new PlacedMesh(Shapes.Cube(), At(7, 2)), true, true));
            IsInset(0.2f, 0.2f, 0.2f, InWorld(new PlacedMesh(Shapes.Cube(), At(7, 2)), false));
            IsInset(0.2f, 0.1f, 0.05f, InWorld(new PlacedMesh(Shapes.Cube(), At(7, 2)) { WorldScale = Scale(1, -2, 4) }));
            IsInset(0.2f, 0.2f, 0.2f, MeshChamfer.Run(Shapes.Cube(), Fifth(new EdgeSettings { worldWidth = true })).Mesh);
        }

        /// Cubes of three scales, of which two are one but for a mirror; an open one rests on the first.
        public static void Each_mesh_of_a_scene_is_measured_in_its_own_scale()
        {
            Mesh plain = Shapes.Cube(), open = Shapes.OpenCube(), wide = Shapes.Cube(), mirrored = Shapes.Cube();
            var objects = new[]
            {
                new PlacedMesh(wide, At(-40, 4)), new PlacedMesh(plain, At(0)), new PlacedMesh(open, At(3, 2)),
                new PlacedMesh(mirrored, At(40, -2)), new PlacedMesh(plain, At(80, 9))
            };
            var progress = new Told();
            var results = MeshChamfer.RunScene(objects, Fifth(new EdgeSettings { worldWidth = true }), progress);
            var told = progress.Values;
            IsInset(0.05f, 0.2f, 0.2f, results[wide].Mesh);
            IsInset(0.1f, 0.2f, 0.2f, results[mirrored].Mesh);
            Check.Equal(4, results[plain].Report.Count(EdgeOutcome.Skipped, EdgeReason.Contact));
            Check.Near(0.2f, Inset(results[plain].Mesh, p => p.x));
            Check.Near(0.2f, Inset(results[plain].Mesh, p => p.y));
            Check.Near(0.1f, 1 - results[open].Mesh.vertices.Max(p => p.x < 0.999f ? p.x : -1));
            Check.That(told.SequenceEqual(told.OrderBy(done => done)) && told.Last() == 1 && told.First() < 0.2f, "rises to 1");
        }

        public static void A_scene_of_several_scales_can_be_cancelled_in_each()
        {
            var cancellation = new CancellationTokenSource();
            var objects = new[] { new PlacedMesh(Shapes.Cube(), At(0)), new PlacedMesh(Shapes.Cube(), At(9, 2)) };
            var progress = new Told { OnReport = done => { if (done > 0.6f) { cancellation.Cancel(); } } };
            Check.Throws<OperationCanceledException>(() =>
                MeshChamfer.RunScene(objects, Fifth(new EdgeSettings { worldWidth = true }), progress, cancellation.Token));
        }

        public static void What_is_scaled_flat_is_named_and_the_rest_chamfered()
        {
            var root = Scene.Holding(Shapes.Cube(), "Root");
            var flat = Scene.Holding(Shapes.Cube(), "Flat");
            Scene.MeshOf(flat).name = "Sheet";
            flat.transform.localScale = Scale(1, 0, 1);
            root.children.Add(flat);
            var modifier = root.AddComponent<ChamferModifier>();
            modifier.includeChildren = true;
            modifier.settings = Fifth(new EdgeSettings { worldWidth = true });
            string why = ModifierActions.Chamfer(modifier).Single();
            Check.That(why.Contains("'Sheet', which is scaled flat") && why.Contains("switch World Width off"), why);
            IsInset(0.2f, 0.2f, 0.2f, Scene.MeshOf(root));
            Check.Equal("Sheet", Scene.MeshOf(flat).name);
        }

        /// Else the library would refuse the whole scene, and not say for which mesh.
        public static void Flat_is_what_the_library_calls_so()
        {
            Func<float, Mesh> with = y => InWorld(new PlacedMesh(Shapes.Cube(), At(0)) { WorldScale = Scale(1, y, 1) });
            with(1.01e-6f);
            Check.That(Check.Throws<InvalidSettingsException>(() => with(0.99e-6f)).Message.Contains("scaled flat"), "told here");
        }

        private static ChamferModifier Modifier(Mesh mesh, Vector3 scale, EdgeSettings edges)
        {
            var modifier = Scene.Holding(mesh, "Item").AddComponent<ChamferModifier>();
            modifier.transform.localScale = scale;
            modifier.settings = Fifth(edges);
            ModifierActions.Chamfer(modifier);
            Undo.Click();
            return modifier;
        }

        public static void Objects_of_one_scale_share_a_mesh()
        {
            var cube = Shapes.Cube();
            var world = new EdgeSettings { worldWidth = true };
            var one = Scene.MeshOf(Modifier(cube, Scale(2, 1, 1), world).gameObject);
            IsInset(0.1f, 0.2f, 0.2f, one);
            Check.That(Scene.MeshOf(Modifier(cube, Scale(2, 1, 1), world).gameObject) == one, "shared");
            Check.That(Scene.MeshOf(Modifier(cube, Scale(2, 1, 2), world).gameObject) != one, "its own");
            var plain = Scene.MeshOf(Modifier(cube, Scale(2, 1, 1), new EdgeSettings()).gameObject);
            Check.That(Scene.MeshOf(Modifier(cube, Scale(2, 1, 2), new EdgeSettings()).gameObject) == plain, "wherever they stand");
        }

        public static void The_scale_above_counts_and_a_change_is_noticed()
        {
            var parent = new GameObject("Parent");
            parent.transform.localScale = Scale(2, 1, 1);
            foreach (bool worldWidth in new[] { true, false })
            {
                var item = Scene.Holding(Shapes.Cube(), "Item");
                parent.children.Add(item);
                var modifier = item.AddComponent<ChamferModifier>();
                modifier.settings = Fifth(new EdgeSettings { worldWidth = worldWidth });
                ModifierActions.Chamfer(modifier);
                Check.Near(worldWidth ? 0.1f : 0.2f, Inset(Scene.MeshOf(item), p => p.x));
                Check.That(!ModifierState.IsOutdated(modifier), "as it should be");
                item.transform.localScale = Scale(1, 1.00001f, 1);
                Check.That(!ModifierState.IsOutdated(modifier), "but for rounding");
                item.transform.localScale = Scale(1, 3, 1);
                Check.Equal(worldWidth, ModifierState.IsOutdated(modifier));
            }
        }

        public static void Modifiers_know_the_materials_of_the_renderer()
        {
            var cube = Shapes.Cube();
            var half = Materials("Wood", 0.5f);
            var wood = Modifier(cube, Scale(1, 1, 1), half);
            IsInset(0.1f, 0.1f, 0.1f, Scene.MeshOf(wood.gameObject));
            Check.That(Scene.MeshOf(Modifier(cube, Scale(1, 1, 1), half).gameObject) == Scene.MeshOf(wood.gameObject), "shared");
            var stone = Scene.Holding(cube, "Stone");
            stone.GetComponent<MeshRenderer>().sharedMaterials = new[] { new Material { name = "Stone" } };
            var modifier = stone.AddComponent<ChamferModifier>();
            modifier.settings = Fifth(half);
            ModifierActions.Chamfer(modifier);
            IsInset(0.2f, 0.2f, 0.2f, Scene.MeshOf(stone));
        }

        /// Its source has changed: the file is written anew, as wide as it was.
        public static void Saved_files_keep_the_scale_and_the_materials()
        {
            var cube = Shapes.Cube();
            AssetDatabase.paths[cube] = "Assets/Edges/Cube.asset";
            var edges = Materials("Wood", 0.5f);
            edges.worldWidth = true;
            var modifier = Modifier(cube, Scale(2, 1, 1), edges);
            var saved = Scene.MeshesIn(ModifierActions.Save(modifier, "Assets/Edges").Single()).Single();
            UnityEngine.Object.DestroyImmediate(modifier);
            cube.colors = cube.vertices.Select(p => new Color(1, 1, 1)).ToArray();
            EditorUtility.SetDirty(cube);
            ModifierMenu.RunInProject();
            Check.That(saved.colors.Length > 0, "written anew");
            IsInset(0.05f, 0.1f, 0.1f, saved);
        }

        /// Structs that are copied share their lists.
        public static void A_list_that_changes_later_changes_nothing_that_was_made()
        {
            var preset = ScriptableObject.CreateInstance<ChamferPreset>();
            preset.Settings = Fifth(Materials("Wood", 0.5f));
            var modifier = Scene.Holding(Shapes.Cube(), "Item").AddComponent<ChamferModifier>();
            modifier.Preset = preset;
            ModifierActions.Chamfer(modifier);
            Check.That(!ModifierState.IsOutdated(modifier), "as it should be");
            // A preview works on another thread meanwhile.
            var effective = modifier.Effective;
            preset.Settings.edges.materials[0].factor = 9;
            effective.edges.materials[0].factor = 9;
            Check.Equal(0.5f, preset.settings.edges.materials[0].factor);
            preset.settings.edges.materials[0].factor = 0.25f;
            Check.Equal(0.5f, modifier.meshes[0].settings.edges.materials[0].factor);
            Check.That(ModifierState.IsOutdated(modifier), "out of date");
        }

        public static void What_is_not_selected_is_grey_and_has_a_word()
        {
            var modifier = Modifier(TwoSubmeshes(), Scale(1, 1, 1), new EdgeSettings { minAngle = 91 });
            Handles.drawn.Clear();
            VerdictOverlay.Draw(modifier);
            Check.Equal(24, Handles.drawn[Color.gray]);
            Check.Equal(0, Handles.drawn[Color.red] + Handles.drawn[Color.green] + Handles.drawn[Color.yellow]);
            Check.That(ReportText.Of(modifier).Contains("12 skipped: not selected"), ReportText.Of(modifier));
        }

        public static void The_inspector_has_them_in_a_group()
        {
            var modifier = Modifier(Shapes.Cube(), Scale(1, 1, 1), new EdgeSettings());
            EditorGUILayout.properties.Clear();
            GUILayout.broken = false;
            new ModifierInspector { target = modifier, targets = new[] { modifier }, serializedObject = new SerializedObject(modifier) }.OnInspectorGUI();
            Check.Equal(1, EditorGUILayout.properties.Count(one => one == "settings.edges*"));
        }

        public static void Each_field_has_a_tooltip()
        {
            var fields = typeof(EdgeSettings).GetFields().Concat(typeof(MaterialFactor).GetFields());
            var bare = fields.Where(field => !field.IsDefined(typeof(TooltipAttribute), false)).Select(field => field.Name);
            Check.Equal("", string.Join(", ", bare));
        }

        /// At which size on the screen a chamfer is a line wide: twice as large an object is farther away then.
        public static void Far_away_is_farther_for_what_is_large_in_the_world()
        {
            Func<Vector3, bool, float> height = (scale, world) =>
            {
                var settings = Fifth(new EdgeSettings { worldWidth = world });
                settings.width = 0.02f;
                var modifier = Scene.Holding(Shapes.Cube(), "Item").AddComponent<ChamferModifier>();
                modifier.transform.localScale = scale;
                modifier.settings = settings;
                ModifierActions.Chamfer(modifier);
                return LodHeight.Of(modifier);
            };
            float plain = height(Scale(1, 1, 1), true);
            Check.Near(plain, height(Scale(-3, 1, 1), false));
            Check.Near(3 * plain, height(Scale(-3, 1, 1), true));
        }
    }
}
