using System;
using System.Globalization;
using Chamfer;
using UnityEditor;
using UnityEngine;

namespace ChamferEditor
{
    /// <summary>
    /// For build machines: <c>Unity -batchmode -quit -projectPath P -executeMethod ChamferEditor.ChamferBatch.Run
    /// -chamferFolder Assets/Props [-chamferPreset Assets/Fine.asset] [-chamferWidth 0.02 | -chamferWidthPercent 1]</c>.
    /// </summary>
    public static class ChamferBatch
    {
        private const int Succeeded = 0;
        private const int SomeFailed = 1;
        private const int BadArguments = 2;

        /// <summary>
        /// Chamfers all models, prefabs and mesh files of a folder and ends the editor: 0 if all went well, 1 if a
        /// mesh could not be chamfered, 2 if the arguments make no sense.
        /// </summary>
        public static void Run()
        {
            EditorApplication.Exit(Run(Environment.GetCommandLineArgs()));
        }

        internal static int Run(string[] arguments)
        {
            try { return ChamferFolder(Value(arguments, "-chamferFolder"), Settings(arguments)); }
            catch (ArgumentException exception)
            {
                Debug.LogError(exception.Message);
                return BadArguments;
            }
        }

        private static int ChamferFolder(string folder, ChamferSettings settings)
        {
            if (folder == null || !AssetDatabase.IsValidFolder(folder))
            {
                throw new ArgumentException("Name a folder of the project with -chamferFolder, such as Assets/Props");
            }
            var summary = new JobSummary();
            bool isDone = FolderChamfer.Run(folder, settings, summary);
            Debug.Log("Chamfer: " + summary);
            return isDone && !summary.HasFailed ? Succeeded : SomeFailed;
        }

        private static ChamferSettings Settings(string[] arguments)
        {
            var settings = Preset(Value(arguments, "-chamferPreset"));
            ReadWidth(arguments, "-chamferWidth", WidthUnit.MeshUnits, ref settings);
            ReadWidth(arguments, "-chamferWidthPercent", WidthUnit.PercentOfExtent, ref settings);
            return settings;
        }

        private static ChamferSettings Preset(string path)
        {
            if (path == null) { return ChamferProjectSettings.instance.settings; }
            var preset = AssetDatabase.LoadAssetAtPath<ChamferPreset>(path);
            if (preset != null) { return preset.settings; }
            throw new ArgumentException("-chamferPreset needs the path of a Chamfer Preset, not '" + path + "'");
        }

        private static void ReadWidth(string[] arguments, string name, WidthUnit unit, ref ChamferSettings settings)
        {
            string text = Value(arguments, name);
            if (text == null) { return; }
            settings.unit = unit;
            if (!float.TryParse(text, NumberStyles.Float, CultureInfo.InvariantCulture, out settings.width))
            {
                throw new ArgumentException(name + " needs a number, not '" + text + "'");
            }
        }

        private static string Value(string[] arguments, string name)
        {
            int place = Array.IndexOf(arguments, name);
            return place >= 0 && place + 1 < arguments.Length ? arguments[place + 1] : null;
        }
    }
}
