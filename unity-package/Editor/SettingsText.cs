using System.Globalization;
using Chamfer;

namespace ChamferEditor
{
    /// <summary>Settings as text: equal texts chamfer alike.</summary>
    internal static class SettingsText
    {
        internal static string Of(ChamferSettings settings)
        {
            return Number(settings.width) + " " + settings.unit + " " + settings.verify + " " + settings.submeshMode + " "
                + settings.submesh + " " + Number(settings.leastBreadth) + Even(settings) + Rounding(settings)
                + Of(settings.edges);
        }

        private static string Even(ChamferSettings settings)
        {
            return settings.evenness == 0 ? "" : " even " + Number(settings.evenness);
        }

        /// <summary>Nothing for flat chamfers: texts of an earlier version are still equal.</summary>
        private static string Rounding(ChamferSettings settings)
        {
            return settings.segments < 2 ? "" : " round " + settings.segments + " " + Number(settings.profile);
        }

        /// <summary>Nothing where nothing is asked for: texts of an earlier version are still equal.</summary>
        private static string Of(EdgeSettings edges)
        {
            string text = " " + edges.widthMode + " " + edges.worldWidth + " " + Number(edges.minAngle) + " "
                + Number(edges.maxAngle) + " " + edges.convexity + " " + Number(edges.hardAngle) + " " + edges.mask;
            foreach (var one in edges.materials ?? new MaterialFactor[0])
            {
                string name = one.material ?? "";
                text += " " + name.Length + ":" + name + "=" + Number(one.factor);
            }
            return text == Usual ? "" : text;
        }

        /// <summary>Of settings that ask for no edges in particular.</summary>
        private const string Usual = " Offset False 0 0 Both 0 None";

        /// <summary>For users.</summary>
        internal static string Words(ChamferSettings settings)
        {
            string unit = settings.unit == WidthUnit.PercentOfExtent ? " percent, " : " units, ";
            return Number(settings.width) + unit + settings.verify
                + (settings.segments > 1 ? ", " + settings.segments + " segments" : "") + (Of(settings.edges).Length > 0 ? ", chosen edges" : "");
        }

        /// <summary>As it is written on every machine, to the last bit.</summary>
        internal static string Number(float number)
        {
            return number.ToString("R", CultureInfo.InvariantCulture);
        }
    }
}
